#include "core/load/placed_points.hpp"

#include "core/contact/surface_gap.hpp"

namespace flankwright {

std::vector<ContactPoint> placed_points(const GearPair& pair, const MeshPlacement& placement, const std::vector<ContactPoint>& points,
                                        double line_phase) {
  if (placement.gap == GapModel::PlaneOfAction) return points;
  FlankCondition unmodified;
  unmodified.misalignment = placement.misalignment;
  return SurfaceGap(pair, unmodified).place(points, line_phase);
}

}  // namespace flankwright
