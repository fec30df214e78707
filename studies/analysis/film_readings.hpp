#pragma once

#include <optional>
#include <vector>

#include "core/fidelity/cycle_extremes.hpp"
#include "core/rating/film_condition.hpp"
#include "core/rating/life_model.hpp"
#include "core/rating/operation.hpp"

namespace flankwright::studies {

/// The oil of a load case, as far as it is known.
struct Oil {
  const Lubricant* lubricant;
  double temperature, roughness;  ///< [deg C], Ra [um]
};

/// Nothing where the study has no lubricant.
std::optional<Oil> oil_of(const LifeModel& life, const Operation& operation);

/// Of film and temperatures; nothing without lubricant or speed.
/// @param force  of the mesh [N]
std::optional<FilmCondition> film_condition_of(const MeshModel& model, const LifeModel& life, const Operation& operation, double force);

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
