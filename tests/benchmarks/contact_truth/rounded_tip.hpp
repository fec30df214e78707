#pragma once

#include "core/gear/gear_pair.hpp"

namespace flankwright::contact_truth {

/// The true rounding between flank and tip cylinder, in the transverse section z = 0: a ball of radius rho that rolls along
/// the tooth touches the tip cylinder and the flank. Its centre runs on the flank's offset, itself an involute helicoid, at the radius
/// r_a - rho, so that the flank ends at the roll length
///
///     sqrt((r_a - rho)^2 - r_b^2) + rho cos(beta_b).
///
/// Unmodified flanks.
class RoundedTip {
 public:
  /// @param helix_rate  of the flank, signed [rad/mm]
  RoundedTip(const Gear& gear, double helix_rate);

  double flank_end() const { return flank_end_; }  ///< roll length [mm]
  double angle() const { return angle_; }          ///< that the ball's normal turns through, from the tip cylinder to the flank [rad]

  struct Polar {
    double radius, angle;  ///< angle from the flank at flank_end(), < 0 into the tooth
  };
  /// @param normal  the ball's, 0 on the tip cylinder .. angle() on the flank [rad]
  Polar at(double normal) const;

 private:
  Polar about_centre(double normal) const;
  double rounding_, centre_, helix_rate_, flank_end_, angle_;
};

}  // namespace flankwright::contact_truth
