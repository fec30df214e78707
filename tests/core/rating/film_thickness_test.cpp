#include "core/rating/film_thickness.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/rating/sliding_loss.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

const Lubricant film_oil{.viscosity_40 = 220.0, .viscosity_100 = 19.0, .density_15 = 895.0, .temperature = 90.0};

FilmCondition film_at(double speed_rpm) {
  return {.speed = speed_rpm * 2.0 * units::pi / 60.0, .oil_temperature = 90.0, .bulk_temperature = 100.0, .friction = 0.05, .roughness = 0.5};
}

ContactPoint point_at(const GearPair& gears, double away) {
  ContactPoint point;
  set_rolls(gears, gears.pitch_point + away, gears.path_length - gears.pitch_point - away, point);
  return point;
}

double modulus() { return 206000.0 / (2.0 * (1.0 - 0.09)); }

}  // namespace

TEST_CASE("A lubricant has the viscosities and the density that it was given", "[core][rating][film]") {
  constexpr double round_off = 1e-12;
  CHECK(film_oil.kinematic_viscosity(40.0).value == Approx(220.0).epsilon(round_off));
  CHECK(film_oil.kinematic_viscosity(100.0).value == Approx(19.0).epsilon(round_off));
  CHECK(film_oil.density(16.0).value == Approx(895.0).epsilon(round_off));
  // A mineral oil of 100 mPa s at 38 deg C: 2.657e-8 * 0.1^0.1348 m^2/N.
  Lubricant thin = film_oil;
  const double eta_38 = thin.dynamic_viscosity(38.0).value;
  CHECK(thin.pressure_viscosity(38.0).value == Approx(2.657e-8 * std::pow(eta_38, 0.1348)).epsilon(round_off));
  CHECK(thin.pressure_viscosity(38.0).value > 1.5e-8);  // as measured of mineral oils: 1.5 .. 3 e-8 m^2/N
  CHECK(thin.pressure_viscosity(38.0).value < 3e-8);
  for (const double temperature : {20.0, 60.0, 110.0}) {
    constexpr double step = 1e-3, discretisation = 1e-7;
    const auto check = [&](auto property) {
      const double difference = ((film_oil.*property)(temperature + step).value - (film_oil.*property)(temperature - step).value) / (2.0 * step);
      CHECK((film_oil.*property)(temperature).slope == Approx(difference).epsilon(discretisation));
    };
    check(&Lubricant::kinematic_viscosity);
    check(&Lubricant::density);
    check(&Lubricant::dynamic_viscosity);
    check(&Lubricant::pressure_viscosity);
  }
}

TEST_CASE("At the pitch point the film is Dowson's and Higginson's line contact", "[core][rating][film]") {
  const GearPair gears = mesh_cases::pair(20, 60, 0, 5, 40);
  const ContactPoint pitch_point = point_at(gears, 0.0);
  const double load = 400.0;
  const LocalFilm film = local_film(gears, modulus(), flank_point(pitch_point, modulus(), load), film_oil, film_at(1500));
  CHECK(film.flash_temperature == tests::about(0.0, 1e-9));  // nothing slides
  // H = h/R = 1.6 (alpha E')^0.6 (eta u/(E' R))^0.7 (w/(E' R))^-0.13 with E' = 2/(sum (1 - nu^2)/E), u the mean speed [Dowson, Higginson 1966], in SI units.
  const double R = 1e-3 * pitch_point.relative_radius, E = 2.0e6 * modulus(), u = film_at(1500).speed * 1e-3 * gears.pitch_point;
  const double alpha = film_oil.pressure_viscosity(100.0).value, eta = film_oil.dynamic_viscosity(100.0).value;
  const double H = 1.6 * std::pow(alpha * E, 0.6) * std::pow(eta * u / (E * R), 0.7) * std::pow(1e3 * load / (E * R), -0.13);
  CHECK(film.thickness == Approx(1e6 * H * R).epsilon(1e-10));  // round-off
  CHECK(film.ratio == Approx(film.thickness / 0.5).epsilon(1e-12));
}

TEST_CASE("The flash temperature is Blok's uniform source over Hertz's width", "[core][rating][film]") {
  const GearPair gears = mesh_cases::pair(20, 60, 15, 5, 40);
  const ContactPoint point = point_at(gears, 6.0);
  const double load = 400.0, w = 1e3 * load;  // N/m
  const FilmCondition condition = film_at(1500);
  const LocalFilm film = local_film(gears, modulus(), flank_point(point, modulus(), load), film_oil, condition);
  const double v1 = condition.speed * 1e-3 * (gears.pitch_point + 6.0),
               v2 = condition.speed / 3.0 * 1e-3 * (gears.path_length - gears.pitch_point - 6.0);
  const double half_width = std::sqrt(4.0 * w * 1e-3 * point.relative_radius / (units::pi * 1e6 * modulus()));
  const double B = std::sqrt(45.0 * 7800.0 * 440.0);
  // 2/sqrt(pi) mu w |v1 - v2| / (B (sqrt v1 + sqrt v2) sqrt(2 b)) [Blok 1937]
  const double blok =
      2.0 / std::sqrt(units::pi) * condition.friction * w * std::abs(v1 - v2) / (B * (std::sqrt(v1) + std::sqrt(v2)) * std::sqrt(2.0 * half_width));
  CHECK(film.flash_temperature == Approx(blok).epsilon(1e-10));  // round-off
  CHECK(film.flash_temperature > 1.0);
}

TEST_CASE("The film has the exponents of its formula and thins with sliding", "[core][rating][film]") {
  constexpr double round_off = 1e-10;
  const GearPair gears = mesh_cases::pair(20, 60, 0, 5, 40);
  const ContactPoint point = point_at(gears, 0.0);
  const LocalFilm film = local_film(gears, modulus(), flank_point(point, modulus(), 300.0), film_oil, film_at(1000));
  CHECK(local_film(gears, modulus(), flank_point(point, modulus(), 600.0), film_oil, film_at(1000)).ratio ==
        Approx(film.ratio * std::pow(2.0, -0.13)).epsilon(round_off));
  CHECK(local_film(gears, modulus(), flank_point(point, modulus(), 300.0), film_oil, film_at(2000)).ratio ==
        Approx(film.ratio * std::pow(2.0, 0.7)).epsilon(round_off));
  FilmCondition frictionless = film_at(1000);
  frictionless.friction = 0.0;
  const ContactPoint sliding = point_at(gears, 7.0);
  CHECK(local_film(gears, modulus(), flank_point(sliding, modulus(), 300.0), film_oil, film_at(1000)).ratio <
        local_film(gears, modulus(), flank_point(sliding, modulus(), 300.0), film_oil, frictionless).ratio);
  CHECK(std::isnan(local_film(gears, modulus(), flank_point(point, modulus(), 0.0), film_oil, film_at(1000)).ratio));
}

TEST_CASE("The derivatives of the film are those of central differences, on flanks and on edges", "[core][rating][film]") {
  const GearPair gears = mesh_cases::pair(20, 60, 15, 5, 40);
  for (const double away : {-5.0, 0.0, 4.0, 8.0}) {
    const ContactPoint point = point_at(gears, away);
    for (const double load : {1.0, 80.0, 700.0}) {
      const LoadedPoint flank = flank_point(point, modulus(), load);
      for (const double sharper : {1.0, 3.0, 8.0}) {
        const LoadedPoint here{point, load, sharper * flank.pressure};
        const auto ratio = [&](double by_load, double by_pressure) {
          return local_film(gears, modulus(), {point, by_load * load, by_pressure * here.pressure}, film_oil, film_at(1500)).ratio;
        };
        constexpr double step = 1e-4, discretisation = 1e-6, no_sliding = 1e-9;
        CAPTURE(away, load, sharper);
        const LocalFilm film = local_film(gears, modulus(), here, film_oil, film_at(1500));
        CHECK(film.by_load * load ==
              Approx((ratio(1.0 + step, 1.0) - ratio(1.0 - step, 1.0)) / (2.0 * step)).epsilon(discretisation).margin(no_sliding * film.ratio));
        CHECK(film.by_pressure * here.pressure == Approx((ratio(1.0, 1.0 + step) - ratio(1.0, 1.0 - step)) / (2.0 * step)).epsilon(discretisation));
      }
    }
  }
}

TEST_CASE("On a tip edge the film is thinner by the pressure and by the heat there, and always there", "[core][rating][film]") {
  const GearPair gears = mesh_cases::pair(20, 60, 0, 5, 40);
  const ContactPoint point = point_at(gears, 6.0);
  const double load = 60.0, sharper = 5.0;
  const LoadedPoint on_flank = flank_point(point, modulus(), load), on_edge{point, load, sharper * on_flank.pressure};
  const auto film = [&](const LoadedPoint& at, const FilmCondition& condition) { return local_film(gears, modulus(), at, film_oil, condition); };
  constexpr double round_off = 1e-10;
  // The same heat comes from a band that is narrower by the ratio of the pressures.
  CHECK(film(on_edge, film_at(1500)).flash_temperature ==
        Approx(std::sqrt(sharper) * film(on_flank, film_at(1500)).flash_temperature).epsilon(round_off));
  FilmCondition frictionless = film_at(1500);
  frictionless.friction = 0.0;
  CHECK(film(on_edge, frictionless).ratio == Approx(film(on_flank, frictionless).ratio * std::pow(sharper, -0.26)).epsilon(round_off));
  CHECK(film(on_edge, film_at(1500)).ratio < film(on_edge, frictionless).ratio);
  // Heat under which no oil is left thins the film on and on.
  double before = INFINITY;
  for (double pressure = 500.0; pressure < 2e5; pressure *= 1.5) {
    const LocalFilm here = film({point, 400.0, pressure}, film_at(6000));
    CAPTURE(pressure, here.flash_temperature);
    CHECK(here.ratio > 0.0);
    CHECK(here.ratio < before);
    CHECK(here.by_pressure < 0.0);
    before = here.ratio;
  }
  CHECK(film({point, 400.0, 2e5}, film_at(6000)).flash_temperature > 500.0);
}

TEST_CASE("Teeth are warmer than the oil by the loss, and as warm as they are said to be", "[core][rating][film]") {
  const GearPair gears = mesh_cases::pair(20, 60, 0, 5, 40);
  FilmCondition given = film_at(1500);
  CHECK(film_condition(gears, 40.0, 5000.0, film_oil, given).bulk_temperature == 100.0);
  given.bulk_temperature = not_given;
  const FilmCondition found = film_condition(gears, 40.0, 5000.0, film_oil, given);
  const double power_kW = 5000.0 * 1e-3 * gears.pinion.base_radius * given.speed * 1e-3;
  const double rise = 7400.0 * std::pow(power_kW * found.friction * ohlendorf_loss_factor(gears) / (gears.centre_distance * 40.0), 0.72);
  CHECK(found.bulk_temperature == Approx(90.0 + rise).epsilon(1e-12));
  CHECK(rise > 1.0);
  CHECK(rise < 60.0);
}
