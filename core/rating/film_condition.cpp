#include "core/rating/film_condition.hpp"

#include <cmath>

#include "core/rating/sliding_loss.hpp"

namespace flankwright {

namespace {

constexpr double metre = 1e3;  // in mm

double mean_friction(const GearPair& pair, double face_width, double force, const Lubricant& lubricant, const FilmCondition& condition) {
  const double v_sum = 2.0 * condition.speed * pair.pitch_point / metre, rho = pitch_point_radius(pair);
  const double F_bt = condition.overload * force * std::cos(pair.base_helix_angle),
               eta = 1e3 * lubricant.dynamic_viscosity(condition.oil_temperature).value;
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

std::optional<Oil> oil_of(const LifeModel& life, const Operation& operation) {
  if (!life.lubricant) return std::nullopt;
  const double temperature = std::isnan(operation.temperature) ? life.lubricant->temperature : operation.temperature;
  return Oil{&*life.lubricant, temperature, life.roughness};
}

std::optional<FilmCondition> film_condition_of(const MeshModel& model, const LifeModel& life, const Operation& operation, double force) {
  const std::optional<Oil> oil = oil_of(life, operation);
  if (!oil || !(operation.speed > 0.0)) return std::nullopt;
  const FilmCondition given{.speed = operation.speed,
                            .oil_temperature = oil->temperature,
                            .bulk_temperature = life.bulk_temperature,
                            .roughness = oil->roughness,
                            .overload = operation.overload()};
  return film_condition(model.pair, model.face_width, force, *oil->lubricant, given);
}

RollingSpeeds rolling_speeds(const GearPair& pair, const ContactPoint& point, double speed) {
  return {speed * pair.pinion.roll_length_at(point.pinion_radius) / metre,
          speed / pair.gear_ratio() * pair.wheel.roll_length_at(point.wheel_radius) / metre};
}

}  // namespace flankwright
