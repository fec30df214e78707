#pragma once

#include <optional>

#include "core/rating/damage.hpp"
#include "core/rating/lubricant.hpp"

namespace flankwright {

/// What the life of a pair depends on beside its loads.
struct LifeModel {
  PerGear<FatigueStrength> strength;
  PerGear<double> rim_thickness{not_given, not_given};  ///< of gears with a rim, for the rim thickness factor [mm]; NaN: a solid body
  std::optional<Lubricant> lubricant;
  double roughness{not_given};             ///< Ra, mean of both flanks [um], > 0
  double bulk_temperature{not_given};      ///< of the teeth [deg C]; NaN: by film_condition()
  double permissible_film{not_given};      ///< lambda_GFP that micropitting safety refers to [-]; NaN: none
  double scuffing_temperature{not_given};  ///< theta_S that scuffing safety refers to [deg C]; NaN: none
};

}  // namespace flankwright
