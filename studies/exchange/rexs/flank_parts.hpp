#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/gear/flank_frame.hpp"

namespace flankwright::studies::rexs {

/// A part of a flank's modification that no key of a study describes.
struct FlankPart {
  std::function<double(double r, double z)> removed{};  ///< material at radius and axial position [mm], transverse base tangent [mm]
  bool along_profile{true}, along_face{true};           ///< whether it changes along the profile, along the face
};

/// The parts of a flank as the points of a measurement grid over the active flank.
struct GriddedParts {
  std::string text;  ///< a grid file, see grid_file.hpp
  int radii{0}, positions{0};
  double departure{0.0};  ///< of the surface through the points from the sum of the parts, at most [mm]; where reliefs start there is some
};

/// The sum of the parts at points that are even in roll length and z.
///
/// @param base_helix_angle  |beta_b| [rad]
/// @throws InvalidInput  where the sum is no flank a grid can have, see make_grid_field()
GriddedParts grid_of(const std::vector<FlankPart>& parts, const FlankFrame& frame, double base_helix_angle);

}  // namespace flankwright::studies::rexs
