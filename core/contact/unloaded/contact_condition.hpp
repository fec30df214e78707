#pragma once

#include "core/contact/assembly/flank_assembly.hpp"

namespace flankwright {

/// Derivatives with respect to roll length and height of the section on the pinion [per mm] and to the pinion's angle [per rad].
struct ContactGradient {
  double rho{0.0}, z{0.0}, phi1{0.0};
};

/// The wheel turned until its flank passes through one point of the pinion's.
struct FlankContact {
  double rho{not_given}, z{not_given};                 ///< on the pinion [mm]; z is the section's unless the wheel's face ends before
  double wheel_radius{not_given}, wheel_z{not_given};  ///< of the point, wheel frame [mm]
  double wheel_roll{not_given};                        ///< sqrt(r^2 - r_b2^2) [mm]
  double wheel_deviation{0.0};                         ///< D of the wheel there [mm]
  double deviation_slope{0.0};                         ///< its derivative with respect to wheel_roll [mm/mm]
  ContactGradient angle;                               ///< of phi2 [rad]
  bool on_wheel_end{false};                            ///< on an end of the wheel's face, short of the section

  Eigen::Vector3d point{Eigen::Vector3d::Zero()};  ///< in the wheel's frame [mm]
  Eigen::Vector3d along_rho{Eigen::Vector3d::Zero()}, along_z{Eigen::Vector3d::Zero()},
      along_phi1{Eigen::Vector3d::Zero()};        ///< derivatives of the point, housing
  Eigen::Vector3d turn{Eigen::Vector3d::Zero()};  ///< d(phi2)/d(point), housing, wherever the point moves [rad/mm]
};

/// One tooth pair at one pinion angle: the wheel angle phi2 that puts the wheel's flank through a point of the pinion's, with its
/// exact gradient, from
///
///     d(phi2) = -n . dq / (n . (e_z x q)),     q the point in the wheel's frame, n normal to the wheel's flank there
///
/// written out for a displaced involute. A section z = const of the pinion is followed only to where the wheel's face
/// ends, and from there on along that end: rho and the height of the section name a point that lies on both faces.
/// Derivatives with respect to rho and phi1 are along that path; there the one with respect to z is that of a wider
/// wheel. Same angle as rotation_through() to round-off, at a fraction of the cost: the gradient needs no trigonometric
/// function of the wheel, the angle itself one.
class ContactCondition {
 public:
  /// @param assembly  must outlive this
  ContactCondition(const FlankAssembly& assembly, int tooth, double phi1);

  /// Valid between the wheel's base and tip cylinders. Beyond, at r < r_b lowest_start or r > r_a, the nearer of these
  /// two radii replaces the point's, which keeps the gradient finite and its sign where no flank is.
  /// @param near  a contact nearby to guess the wheel's deviation from; affects the speed, not the result
  FlankContact at(double rho, double z, const FlankContact* near = nullptr) const;

  double phi2(const FlankContact& contact) const;                      ///< [rad]
  ContactGradient radius_gradient(const FlankContact& contact) const;  ///< of wheel_radius [mm]
  ContactGradient axial_gradient(const FlankContact& contact) const;   ///< of wheel_z [mm]

  /// Roll length on the pinion where undisturbed, parallel gears touch in the section z [mm]; any sign.
  double undisturbed_roll(double z) const { return roll_at_mid_face_ + roll_rate() * z; }
  /// Between these it lies on both profiles [mm].
  double lowest_undisturbed_roll() const { return std::max(assembly_.pinion.lowest_roll(), path_length_ - assembly_.wheel.highest_roll()); }
  double highest_undisturbed_roll() const { return std::min(assembly_.pinion.highest_roll(), path_length_ - assembly_.wheel.lowest_roll()); }
  double roll_rate() const { return assembly_.pinion.base_radius * assembly_.pinion.helix_rate; }  ///< its derivative [mm/mm]

  /// Curvature -d2(phi2)/d(rho1)2 where undisturbed involutes touch at roll length rho1 of the pinion [rad/mm^2]:
  ///
  ///     (1/rho1 + 1/rho2)(rho1/r_b1)^2 / r_b2,     rho1 + rho2 the distance between the base circles' tangent points
  ///
  /// Beyond the path's end at the wheel's base circle rho2 is taken as 1/100 of that distance.
  double undisturbed_curvature(double rho1) const;

  const FlankAssembly& assembly() const { return assembly_; }

 private:
  /// Flank::deviation() of one tooth with its gradient, and what is constant over the flank.
  struct Deviation {
    Deviation(const Flank& of, int tooth);
    Dual<2> at(double rho, double z) const;

    const Flank& flank;
    DeviationFormula formula;
    double pitch;                    ///< [mm]
    const DeviationField* measured;  ///< of this tooth; null: none
    double per_base_radius;          ///< 1/r_b [1/mm]
  };

  /// Point of the pinion's flank and its derivatives, in the housing and in the wheel's frame.
  void locate_point(FlankContact& contact) const;
  /// Moves a point that lies beyond the wheel's face along z onto its end.
  void move_onto_wheel_face(FlankContact& contact) const;

  const FlankAssembly& assembly_;
  Deviation pinion_, wheel_;
  double pinion_origin_;  ///< theta of the involute's start at z = 0, turned [rad]
  double wheel_origin_;   ///< the wheel's at rotation 0, less its advance by whole pitches [rad]
  double roll_at_mid_face_;
  double path_length_;  ///< between the base circles' tangent points [mm]
};

}  // namespace flankwright
