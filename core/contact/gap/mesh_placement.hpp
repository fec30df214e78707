#pragma once

#include "core/contact/assembly/misalignment.hpp"
#include "core/contact/gap/gap_model.hpp"

namespace flankwright {

/// The gap model, and the part of the misalignment that moves its points; of shafts that depend on the load, the load: two load cases with the same
/// placement share a mesh model.
struct MeshPlacement {
  GapModel gap{GapModel::PlaneOfAction};
  Misalignment misalignment{};  ///< PlaneOfAction: the axial offset, which shortens the common face; WholeSurface: all of it
  /// On the pinion, at which shafts with clearances are linearised [N mm]; 0: they do not depend on the load.
  double torque{0.0};
  bool other_flanks{false};  ///< as FlankCondition has it

  static MeshPlacement of(GapModel gap, const Misalignment& misalignment, double torque = 0.0);
  auto operator<=>(const MeshPlacement&) const = default;
};

}  // namespace flankwright
