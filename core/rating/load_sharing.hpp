#pragma once

#include <vector>

#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// What one tooth pair carries at a mesh position.
struct ToothShare {
  int tooth{0};
  double share{0.0};  ///< sum over its points of a w, by F [-]; 0 .. 1
};

/// Of every tooth pair that has a contact point, by rising tooth; sum 1 to the solver's residual. Empty where the position failed or
/// nothing is loaded.
std::vector<ToothShare> load_sharing(const MeshPosition& at, const LoadedPosition& loaded);

}  // namespace flankwright
