#pragma once

#include <string>
#include <vector>

#include "core/contact/assembly/misalignment.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright::studies {

/// Why gears cannot mesh in a scene.
struct PlacementProblem {
  std::string key;      ///< of the misalignment
  double value;         ///< [mm]
  std::string allowed;  ///< in words
};

/// Gears mesh where no tip is in the mate's root, the total contact ratio is at least 1, and their faces have a part in common.
std::vector<PlacementProblem> placement_problems(const GearPair& pair, const Misalignment& misalignment);

}  // namespace flankwright::studies
