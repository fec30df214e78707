#pragma once

#include <vector>

#include "core/contact/contact_points.hpp"
#include "core/load/mesh_model.hpp"

namespace flankwright {

/// Points of the plane of action where a placement has them: there, or where the misaligned, unmodified flanks are nearest
/// in the same sections (SurfaceGap::place), without those whose sections miss the mate.
/// @param line_phase  that the points were made for
std::vector<ContactPoint> placed_points(const GearPair& pair, const MeshPlacement& placement, const std::vector<ContactPoint>& points,
                                        double line_phase);

}  // namespace flankwright
