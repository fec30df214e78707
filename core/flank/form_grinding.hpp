#pragma once

#include "core/gear/pair_geometry.hpp"

namespace flankwright {

/// Where a form-grinding wheel touches the flank of a helical gear. The wheel is a surface of revolution. Its axis crosses the line through the gear's
/// axis and the middle of a tooth space at the distance a = d/2 + r_f and is swivelled by the helix angle at the reference circle. A surface of
/// revolution touches the flank where the flank's normal meets the wheel's axis. With delta the angle of the base tangent of roll length rho against
/// the middle of the space, T = tan(beta) and tau = tan(beta_b), both signed as Flank::helix_rate, that is
///
///     -z sin(delta) + T (a cos(delta) - r_b) + tau (r_b cos(delta) - rho sin(delta) - a) = 0,
///     delta = inv(alpha_t) - e/(2 r) + tau z/r_b - rho/r_b,       e the width of the space at the reference circle
///
/// one point for each rho: the contact line z(rho), counted from the wheel's own position. On a spur gear z = 0.
class FormWheelContact {
 public:
  /// @param wheel_diameter  d [mm], > 0
  FormWheelContact(const GearPair& pair, Member member, double wheel_diameter);

  /// z of the contact line at roll length rho > 0 [mm], to round-off.
  /// @param near  where the search starts [mm], such as the z of a neighbouring point
  /// @throws InvalidInput "grinding_wheel_diameter" where no single point of that rho is touched
  double position(double rho, double near = 0.0) const;

 private:
  double base_radius_, helix_rate_;     ///< r_b [mm], tau/r_b [rad/mm]
  double tan_swivel_, tan_base_helix_;  ///< T, tau
  double axis_distance_;                ///< a [mm]
  double start_;                        ///< delta at rho = 0, z = 0 [rad]
  double wheel_diameter_;
};

}  // namespace flankwright
