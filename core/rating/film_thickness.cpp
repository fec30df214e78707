#include "core/rating/film_thickness.hpp"

#include <cmath>

#include "core/rating/contact_temperature.hpp"

namespace flankwright {

LocalFilm local_film(const GearPair& pair, double contact_modulus, const ContactPoint& point, double line_load, const Lubricant& lubricant,
                     const FilmCondition& condition) {
  LocalFilm film;
  const auto [v_1, v_2] = rolling_speeds(pair, point, condition.speed);
  if (!(line_load > 0.0) || !(v_1 + v_2 > 0.0)) return film;
  const double E_r = 2.0 * contact_modulus, rho = point.relative_radius;
  const double p = std::sqrt(condition.overload * line_load * contact_modulus / (units::pi * rho));
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
