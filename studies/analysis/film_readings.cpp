#include "studies/analysis/film_readings.hpp"

#include <cmath>

#include "core/rating/contact_temperature.hpp"
#include "core/rating/film_thickness.hpp"

namespace flankwright::studies {

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

std::vector<PointReading> film_readings(const MeshModel& model, const LifeModel& life, const Operation& operation, double force) {
  const std::optional<FilmCondition> film = film_condition_of(model, life, operation, force);
  if (!film) return {};
  std::vector<PointReading> readings(2);
  readings[FilmReadings::flash] = [&model, film = *film](const ContactPoint& point, double load) {
    return local_temperature(model.pair, model.contact_modulus, point, load, film).flash;
  };
  readings[FilmReadings::thinness] = [&model, &oil = *life.lubricant, film = *film](const ContactPoint& point, double load) {
    return 1.0 / local_film(model.pair, model.contact_modulus, point, load, oil, film).ratio;
  };
  return readings;
}

}  // namespace flankwright::studies
