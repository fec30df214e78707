#pragma once

#include <vector>

#include "core/contact/gap/gap.hpp"

namespace flankwright {

/// The gap model, and the part of the misalignment that moves its points: two conditions with the same placement share
/// a mesh model.
struct MeshPlacement {
  GapModel gap{GapModel::PlaneOfAction};
  Misalignment misalignment{};  ///< PlaneOfAction: the axial offset, which shortens the common face; WholeSurface: all of it

  static MeshPlacement of(GapModel gap, const Misalignment& misalignment);
  auto operator<=>(const MeshPlacement&) const = default;
};

}  // namespace flankwright
