#pragma once

#include <Eigen/Geometry>

#include "core/contact/assembly/flank_condition.hpp"
#include "core/flank/flank.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Two flanks assembled with misalignment: the input of unloaded contact analysis.
///
/// Housing frame W: origin at the pinion's mid face, x along the line of centres to the wheel, z along the pinion's axis,
/// y = z x x. The pinion turns by phi1 about +z, the wheel by phi2 the other way round. A left working flank is analysed as
/// its mirror image in the plane y = 0: hand of helix and `crossing` change sign, phi1 and phi2 count in the direction of drive.
struct FlankAssembly {
  Flank pinion, wheel;           ///< each in its own frame, x towards the mate
  Eigen::Matrix3d wheel_axes;    ///< columns: wheel frame axes in W; the wheel frame is turned by pi about z, then tilted
  Eigen::Vector3d wheel_centre;  ///< mid-face centre of the wheel in W [mm]
  int pinion_teeth{0}, wheel_teeth{0};

  Flank& operator[](Member m) { return m == Member::Pinion ? pinion : wheel; }
  const Flank& operator[](Member m) const { return m == Member::Pinion ? pinion : wheel; }
  double speed_ratio() const { return static_cast<double>(pinion_teeth) / wheel_teeth; }
};

/// Places the flanks of a pair. Lead-angle and pressure-angle error of the pinion change its helicoid:
/// - pinion_lead_angle: TM-107451, appendix 2 in full: lambda_p1 changes, alpha_n is kept, so r_p1, r_b1 and p_1 follow;
/// - pinion_pressure_angle: eqs 15-17: alpha_n changes, r_p1 and the helix angle on it are kept, so alpha_t, r_b1, lambda_b1 follow.
/// In both the flank's angular position at the (changed) pitch cylinder and the tip and form radii stay.
/// The tilts of the wheel are combined into one rotation vector.
/// @throws InvalidInput where an error leaves no usable helicoid
FlankAssembly assemble_flanks(const GearPair& pair, const FlankCondition& condition);

}  // namespace flankwright
