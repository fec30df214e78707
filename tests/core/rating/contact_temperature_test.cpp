#include "core/rating/contact_temperature.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/rating/film_thickness.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

const GearPair& hot_gears() {
  static const GearPair gears = mesh_cases::pair(20, 60, 15, 5, 40);
  return gears;
}

constexpr double hot_modulus = 206000.0 / (2.0 * (1.0 - 0.09));

FilmCondition hot_condition(double speed_rpm, double friction = 0.05) {
  return {.speed = speed_rpm * 2.0 * units::pi / 60.0, .oil_temperature = 80.0, .bulk_temperature = 95.0, .friction = friction, .roughness = 0.5};
}

/// A contact point some way along the line of action from the pitch point [mm].
ContactPoint hot_point(double away) {
  ContactPoint point;
  set_rolls(hot_gears(), hot_gears().pitch_point + away, hot_gears().path_length - hot_gears().pitch_point - away, point);
  return point;
}

double flash_at(double away, double load, const FilmCondition& condition, HeatSource source = HeatSource::Hertzian) {
  return flash_temperature(hot_gears(), flank_point(hot_point(away), hot_modulus, load), condition, source);
}

/// Largest temperature under a band of width 2b that moves over a half space so fast that heat goes inwards alone, in units of q_m sqrt(2b)/(B sqrt(v)): the
/// integral of q(s)/(q_m sqrt(pi (x - s))) over the part of the band that has passed, by the substitution s = x - t^2, largest over x.
template <class Source>
double largest_rise(const Source& relative_heat) {
  constexpr int steps = 2000, places = 1000;
  double largest = 0.0;
  for (int i = 1; i <= places; ++i) {
    const double x = -1.0 + 2.0 * i / places, end = std::sqrt(x + 1.0);  // half widths
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double t = end * (k + 0.5) / steps;
      sum += 2.0 * relative_heat(x - t * t) * end / steps;
    }
    largest = std::max(largest, sum / std::sqrt(2.0 * units::pi));
  }
  return largest;
}

}  // namespace

TEST_CASE("The flash temperature is that of a moving band of friction heat", "[core][rating][flash]") {
  const double uniform = largest_rise([](double) { return 1.0; });
  const double hertzian = largest_rise([](double s) { return 4.0 / units::pi * std::sqrt(std::max(0.0, 1.0 - s * s)); });
  constexpr double round_off = 1e-10, quadrature = 1e-4;
  CHECK(uniform == Approx(2.0 / std::sqrt(units::pi)).epsilon(round_off));
  CHECK(hertzian == Approx(1.11).epsilon(2e-3));  // the standard rounds 1.1115
  CHECK(hertzian < uniform);
  const double load = 400.0, away = 6.0;
  const FilmCondition condition = hot_condition(1500);
  const ContactPoint point = hot_point(away);
  const double v1 = condition.speed * 1e-3 * (hot_gears().pitch_point + away);
  const double v2 = condition.speed / 3.0 * 1e-3 * (hot_gears().path_length - hot_gears().pitch_point - away);
  const double w = 1e3 * load, b = std::sqrt(4.0 * w * 1e-3 * point.relative_radius / (units::pi * 1e6 * hot_modulus));  // N/m, m
  const double B = std::sqrt(45.0 * 7800.0 * 440.0), heat = condition.friction * w * std::abs(v1 - v2) / (2.0 * b);      // W/m^2, mean of the band
  // Each flank takes so much of the heat that both are as hot: rises per heat r_1, r_2 in parallel.
  const auto rise = [&](double coefficient) {
    const double r1 = coefficient * std::sqrt(2.0 * b) / (B * std::sqrt(v1)), r2 = coefficient * std::sqrt(2.0 * b) / (B * std::sqrt(v2));
    return heat / (1.0 / r1 + 1.0 / r2);
  };
  CHECK(flash_at(away, load, condition, HeatSource::Uniform) == Approx(rise(uniform)).epsilon(quadrature));
  CHECK(flash_at(away, load, condition) == Approx(rise(hertzian)).epsilon(2e-3));
  CHECK(flash_at(away, load, condition) > 1.0);
  // The film of ISO/TS 6336-22 has the uniform source.
  const Lubricant oil{.viscosity_40 = 220.0, .viscosity_100 = 19.0, .temperature = 80.0};
  CHECK(local_film(hot_gears(), hot_modulus, flank_point(point, hot_modulus, load), oil, condition).flash_temperature ==
        flash_at(away, load, condition, HeatSource::Uniform));
}

TEST_CASE("Nothing flashes where nothing slides or nothing is loaded", "[core][rating][flash]") {
  CHECK(flash_at(0.0, 500.0, hot_condition(1500)) == tests::about(0.0, 1e-9));  // round-off of the two speeds
  CHECK(flash_at(5.0, 0.0, hot_condition(1500)) == 0.0);
  CHECK(flash_at(5.0, 500.0, hot_condition(0.0)) == 0.0);
  CHECK(flash_at(5.0, 500.0, hot_condition(1500, 0.0)) == 0.0);
  const LocalTemperature unloaded = local_temperature(hot_gears(), flank_point(hot_point(5.0), hot_modulus, 0.0), hot_condition(1500));
  CHECK(unloaded.contact == 95.0);
  CHECK(unloaded.by_load == 0.0);
  CHECK(unloaded.by_pressure == 0.0);
  for (const double away : {-6.0, -2.0, 2.0, 6.0}) CHECK(flash_at(away, 500.0, hot_condition(1500)) > 0.0);
}

TEST_CASE("The flash temperature has the powers of its formula", "[core][rating][flash]") {
  constexpr double round_off = 1e-12;
  const double flash = flash_at(5.0, 300.0, hot_condition(1000));
  CHECK(flash_at(5.0, 600.0, hot_condition(1000)) == Approx(flash * std::pow(2.0, 0.75)).epsilon(round_off));
  CHECK(flash_at(5.0, 300.0, hot_condition(4000)) == Approx(2.0 * flash).epsilon(round_off));
  CHECK(flash_at(5.0, 300.0, hot_condition(1000, 0.15)) == Approx(3.0 * flash).epsilon(round_off));
  const LocalTemperature local = local_temperature(hot_gears(), flank_point(hot_point(5.0), hot_modulus, 300.0), hot_condition(1000));
  CHECK(local.flash == flash);
  CHECK(local.contact == 95.0 + flash);
}

TEST_CASE("The derivatives of the contact temperature are those of central differences", "[core][rating][flash]") {
  for (const double away : {-6.0, 3.0, 8.0}) {
    for (const double load : {1.0, 80.0, 700.0}) {
      const ContactPoint point = hot_point(away);
      const double pressure = 4.0 * flank_point(point, hot_modulus, load).pressure, step = 1e-4;  // as on an edge
      const auto at = [&](double by_load, double by_pressure) {
        return local_temperature(hot_gears(), {point, by_load * load, by_pressure * pressure}, hot_condition(1500));
      };
      CHECK(at(1.0, 1.0).by_load * load == Approx((at(1.0 + step, 1.0).contact - at(1.0 - step, 1.0).contact) / (2.0 * step)).epsilon(1e-6));
      CHECK(at(1.0, 1.0).by_pressure * pressure == Approx((at(1.0, 1.0 + step).contact - at(1.0, 1.0 - step).contact) / (2.0 * step)).epsilon(1e-6));
    }
  }
}

TEST_CASE("Scuffing is safe by the distance of temperatures from the oil's", "[core][rating][flash]") {
  CHECK(scuffing_safety(240.0, 240.0, 80.0) == 1.0);
  CHECK(scuffing_safety(240.0, 160.0, 80.0) == 2.0);
  CHECK(scuffing_safety(240.0, 400.0, 80.0) == 0.5);
}
