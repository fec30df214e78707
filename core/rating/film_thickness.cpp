#include "core/rating/film_thickness.hpp"

#include <cmath>

#include "core/rating/contact_temperature.hpp"
#include "core/rating/sliding_loss.hpp"

namespace flankwright {

namespace {

constexpr double metre = 1e3;  // in mm

double mean_friction(const GearPair& pair, double face_width, double force, const Lubricant& lubricant, const FilmCondition& condition) {
  const double v_sum = 2.0 * condition.speed * pair.pitch_point / metre, rho = pitch_point_radius(pair);
  const double F_bt = force * std::cos(pair.base_helix_angle), eta = 1e3 * lubricant.dynamic_viscosity(condition.oil_temperature).value;
  double X_L = 1.0;
  if (lubricant.base == BaseOil::Polyalphaolefin) X_L = 0.8;
  if (lubricant.base == BaseOil::Polyglycol) X_L = 0.75 * std::pow(6.0 / v_sum, 0.2);
  return 0.045 * std::pow(F_bt / (face_width * v_sum * rho), 0.2) * std::pow(eta, -0.05) * X_L * 2.2 * std::pow(condition.roughness / rho, 0.25);
}

}  // namespace

FilmCondition film_condition(const GearPair& pair, double face_width, double force, const Lubricant& lubricant, FilmCondition given) {
  given.friction = mean_friction(pair, face_width, force, lubricant, given);
  if (!std::isnan(given.bulk_temperature)) return given;
  constexpr double kilowatt = 1e6;  // N mm/s
  const double power = force * std::cos(pair.base_helix_angle) * pair.pinion.base_radius * given.speed / kilowatt;
  const double loss = power * given.friction * ohlendorf_loss_factor(pair) / (pair.centre_distance * face_width);
  given.bulk_temperature = given.oil_temperature + 7400.0 * std::pow(loss, 0.72);
  return given;
}

RollingSpeeds rolling_speeds(const GearPair& pair, const ContactPoint& point, double speed) {
  return {speed * pair.pinion.roll_length_at(point.pinion_radius) / metre,
          speed / pair.gear_ratio() * pair.wheel.roll_length_at(point.wheel_radius) / metre};
}

LocalFilm local_film(const GearPair& pair, double contact_modulus, const ContactPoint& point, double line_load, const Lubricant& lubricant,
                     const FilmCondition& condition) {
  LocalFilm film;
  const auto [v_1, v_2] = rolling_speeds(pair, point, condition.speed);
  if (!(line_load > 0.0) || !(v_1 + v_2 > 0.0)) return film;
  const double E_r = 2.0 * contact_modulus, rho = point.relative_radius;
  const double p = std::sqrt(line_load * contact_modulus / (units::pi * rho));
  film.flash_temperature = flash_temperature(pair, contact_modulus, point, line_load, condition, HeatSource::Uniform);
  const double theta_B = condition.bulk_temperature + film.flash_temperature;
  const Lubricant::Property alpha = lubricant.pressure_viscosity(condition.bulk_temperature), alpha_B = lubricant.pressure_viscosity(theta_B);
  const Lubricant::Property eta = lubricant.dynamic_viscosity(condition.bulk_temperature), eta_B = lubricant.dynamic_viscosity(theta_B);
  const double G = 1e6 * alpha.value * E_r, U = eta.value * (v_1 + v_2) / (2000.0 * E_r * rho), W = 2.0 * units::pi * p * p / (E_r * E_r);
  const double S = alpha_B.value * eta_B.value / (alpha.value * eta.value);
  film.thickness = 1600.0 * rho * std::pow(G, 0.6) * std::pow(U, 0.7) * std::pow(W, -0.13) * std::pow(S, 0.22);
  film.ratio = film.thickness / condition.roughness;
  // W grows as the load, theta_fl as p^1.5.
  const double by_temperature = 0.22 * (alpha_B.slope / alpha_B.value + eta_B.slope / eta_B.value);
  film.slope = film.ratio * (-0.13 + by_temperature * 0.75 * film.flash_temperature) / line_load;
  return film;
}

}  // namespace flankwright
