#include "core/contact/gap/mesh_placement.hpp"

namespace flankwright {

MeshPlacement MeshPlacement::of(GapModel gap, const Misalignment& misalignment, double torque) {
  MeshPlacement placement{gap, {}, torque};
  placement.misalignment.axial_offset = misalignment.axial_offset;
  if (gap == GapModel::WholeSurface) placement.misalignment = misalignment;
  return placement;
}

}  // namespace flankwright
