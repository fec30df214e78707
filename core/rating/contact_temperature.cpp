#include "core/rating/contact_temperature.hpp"

#include <cmath>

namespace flankwright {

namespace {

const double thermal_contact_coefficient = std::sqrt(45.0 * 7800.0 * 440.0);  // of steel [N/(m s^0.5 K)]
const double uniform_coefficient = 2.0 / std::sqrt(units::pi);
constexpr double hertzian_coefficient = 1.11;

}  // namespace

double flash_temperature(const GearPair& pair, const LoadedPoint& at, const FilmCondition& condition, HeatSource source) {
  const auto [v_1, v_2] = rolling_speeds(pair, at.point, condition.speed);
  if (!(at.line_load > 0.0) || !(v_1 + v_2 > 0.0)) return 0.0;
  constexpr double metre = 1e3;  // in mm
  const double w = condition.overload * at.line_load, p = std::sqrt(condition.overload) * at.pressure, b_H = 2.0 * w / (units::pi * p);
  const double coefficient = source == HeatSource::Uniform ? uniform_coefficient : hertzian_coefficient;
  return coefficient * condition.friction * metre * w * std::abs(v_1 - v_2) /
         (thermal_contact_coefficient * (std::sqrt(v_1) + std::sqrt(v_2)) * std::sqrt(2.0 * b_H / metre));
}

LocalTemperature local_temperature(const GearPair& pair, const LoadedPoint& at, const FilmCondition& condition) {
  LocalTemperature local;
  local.flash = flash_temperature(pair, at, condition, HeatSource::Hertzian);
  local.contact = condition.bulk_temperature + local.flash;
  local.by_load = at.line_load > 0.0 ? 0.5 * local.flash / at.line_load : 0.0;
  local.by_pressure = at.line_load > 0.0 ? 0.5 * local.flash / at.pressure : 0.0;
  return local;
}

}  // namespace flankwright
