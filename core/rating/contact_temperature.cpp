#include "core/rating/contact_temperature.hpp"

#include <cmath>

namespace flankwright {

namespace {

const double thermal_contact_coefficient = std::sqrt(45.0 * 7800.0 * 440.0);  // of steel [N/(m s^0.5 K)]
const double uniform_coefficient = 2.0 / std::sqrt(units::pi);
constexpr double hertzian_coefficient = 1.11;

}  // namespace

double flash_temperature(const GearPair& pair, double contact_modulus, const LoadedPoint& at, const FilmCondition& condition, HeatSource source) {
  const auto [v_1, v_2] = rolling_speeds(pair, at.point, condition.speed);
  if (!(at.line_load > 0.0) || !(v_1 + v_2 > 0.0)) return 0.0;
  const double E_r = 2.0 * contact_modulus, rho = at.radius(contact_modulus), p = std::sqrt(condition.overload) * at.pressure;
  // Of the uniform source, with w = 2 pi rho p^2 / E_r and 2 b_H = 8 rho p / E_r.
  const double uniform = std::sqrt(units::pi) / 2.0 * condition.friction * 1e6 * p * std::abs(v_1 - v_2) /
                         (thermal_contact_coefficient * (std::sqrt(v_1) + std::sqrt(v_2))) * std::sqrt(8.0 * rho * p / (1000.0 * E_r));
  return source == HeatSource::Uniform ? uniform : hertzian_coefficient / uniform_coefficient * uniform;
}

LocalTemperature local_temperature(const GearPair& pair, double contact_modulus, const LoadedPoint& at, const FilmCondition& condition) {
  LocalTemperature local;
  local.flash = flash_temperature(pair, contact_modulus, at, condition, HeatSource::Hertzian);
  local.contact = condition.bulk_temperature + local.flash;
  local.by_load = at.line_load > 0.0 ? 0.5 * local.flash / at.line_load : 0.0;
  local.by_pressure = at.line_load > 0.0 ? 0.5 * local.flash / at.pressure : 0.0;
  return local;
}

}  // namespace flankwright
