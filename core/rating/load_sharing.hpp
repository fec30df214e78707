#pragma once

#include <vector>

#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// The load on one tooth pair at a mesh position.
struct ToothShare {
  int tooth{0};
  double share{0.0};  ///< sum over its points of a w, by F [-]; 0 .. 1
};

/// One entry per tooth pair with a contact point, by rising tooth; their sum is 1 to the solver's residual. Empty where
/// the position failed or nothing is loaded.
std::vector<ToothShare> load_sharing(const MeshPosition& at, const LoadedPosition& loaded);

}  // namespace flankwright
