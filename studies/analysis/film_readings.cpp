#include "studies/analysis/film_readings.hpp"

#include "core/rating/contact_temperature.hpp"
#include "core/rating/film_thickness.hpp"

namespace flankwright::studies {

std::vector<PointReading> film_readings(const MeshModel& model, const LifeModel& life, const Operation& operation, double force) {
  const std::optional<FilmCondition> film = film_condition_of(model, life, operation, force);
  if (!film) return {};
  std::vector<PointReading> readings(2);
  readings[FilmReadings::flash] = [&model, film = *film](const LoadedPoint& at) { return local_temperature(model.pair, at, film).flash; };
  readings[FilmReadings::thinness] = [&model, &oil = *life.lubricant, film = *film](const LoadedPoint& at) {
    return 1.0 / local_film(model.pair, model.contact_modulus, at, oil, film).ratio;
  };
  return readings;
}

}  // namespace flankwright::studies
