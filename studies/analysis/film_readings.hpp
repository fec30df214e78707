#pragma once

#include <vector>

#include "core/fidelity/cycle_extremes.hpp"
#include "core/rating/film_condition.hpp"
#include "core/rating/life_model.hpp"
#include "core/rating/operation.hpp"

namespace flankwright::studies {

/// Entries of film_readings().
struct FilmReadings {
  static constexpr std::size_t flash = 0;     ///< flash temperature [K]
  static constexpr std::size_t thinness = 1;  ///< reciprocal of the specific film thickness [-]
};

/// What is sought over the cycle of a load case beside its own figures.
/// @param model  lives on, life likewise
/// @return       empty without lubricant or speed
std::vector<PointReading> film_readings(const MeshModel& model, const LifeModel& life, const Operation& operation, double force);

}  // namespace flankwright::studies
