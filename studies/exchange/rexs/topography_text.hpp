#pragma once

#include <string>
#include <vector>

namespace flankwright::studies::rexs {

/// A point of a topographical_modification.
struct TopographyPoint {
  double radius;   ///< [mm]
  double z;        ///< from mid face [mm]
  double removed;  ///< along the transverse base tangent [mm]
};

/// The points as a grid file, whose deviations are those along the normal, + outwards.
/// @param name         of the component, as a comment
/// @param base_helix   beta_b, by which amounts along the base tangent become those along the normal [rad]
std::string topography_text(const std::vector<TopographyPoint>& points, const std::string& name, double base_helix);

}  // namespace flankwright::studies::rexs
