#pragma once

#include <cmath>

#include "core/compliance/shaft/shaft_pair.hpp"
#include "core/contact/path/path_of_contact.hpp"

namespace flankwright {

/// How far the pinion's flank yields along the normal at the pitch point at mid face, all of the force there [mm].
/// @param torque  on the pinion [N mm]
inline auto lag_at_pitch_point(const ShaftPair& shafts, const GearPair& pair, double torque) {
  ContactPoint pitch;
  const PathOfContact path(pair);
  pitch.phase = (pair.pitch_point - path.roll_at_start) / path.base_pitch;
  const Eigen::VectorXd force = Eigen::VectorXd::Constant(1, torque / (pair.pinion.base_radius * std::cos(pair.base_helix_angle)));
  return shafts.motion(Member::Pinion, {pitch}, force, 0.0).displacement;
}

}  // namespace flankwright
