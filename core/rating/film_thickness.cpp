#include "core/rating/film_thickness.hpp"

#include <algorithm>
#include <cmath>

#include "core/rating/contact_temperature.hpp"

namespace flankwright {

namespace {

/// The logarithm of alpha eta, see local_film().
Lubricant::Property film_forming(const Lubricant& lubricant, double temperature) {
  constexpr double highest = 300.0;  // deg C
  const double within = std::min(temperature, highest);
  const Lubricant::Property alpha = lubricant.pressure_viscosity(within), eta = lubricant.dynamic_viscosity(within);
  const double slope = alpha.slope / alpha.value + eta.slope / eta.value;
  return {std::log(alpha.value * eta.value) + slope * (temperature - within), slope};
}

}  // namespace

LocalFilm local_film(const GearPair& pair, double contact_modulus, const LoadedPoint& at, const Lubricant& lubricant,
                     const FilmCondition& condition) {
  LocalFilm film;
  const auto [v_1, v_2] = rolling_speeds(pair, at.point, condition.speed);
  if (!(at.line_load > 0.0) || !(v_1 + v_2 > 0.0)) return film;
  const double E_r = 2.0 * contact_modulus, rho = at.point.relative_radius, p = std::sqrt(condition.overload) * at.pressure;
  film.flash_temperature = flash_temperature(pair, at, condition, HeatSource::Uniform);
  const double alpha = lubricant.pressure_viscosity(condition.bulk_temperature).value,
               eta = lubricant.dynamic_viscosity(condition.bulk_temperature).value;
  const double G = 1e6 * alpha * E_r, U = eta * (v_1 + v_2) / (2000.0 * E_r * rho), W = 2.0 * units::pi * p * p / (E_r * E_r);
  const Lubricant::Property hot = film_forming(lubricant, condition.bulk_temperature + film.flash_temperature);
  const double S = std::exp(hot.value) / (alpha * eta);
  film.thickness = 1600.0 * rho * std::pow(G, 0.6) * std::pow(U, 0.7) * std::pow(W, -0.13) * std::pow(S, 0.22);
  film.ratio = film.thickness / condition.roughness;
  // W ~ p^2 and theta_fl ~ (w p)^0.5.
  const double by_heat = 0.22 * hot.slope * 0.5 * film.flash_temperature;
  film.by_load = film.ratio * by_heat / at.line_load;
  film.by_pressure = film.ratio * (-0.26 + by_heat) / at.pressure;
  return film;
}

}  // namespace flankwright
