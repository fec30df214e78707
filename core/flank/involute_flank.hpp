#pragma once

#include <cmath>

#include "core/base/dual.hpp"
#include "core/flank/removal.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// At the base circle the involute ends in a cusp without a normal, where any removal folds the flank over itself. A flank is
/// taken to start at this multiple of r_b at least, at a roll length of r_b/100: form_radius >= r_b * lowest_start.
inline constexpr double lowest_start = 1.0 + 5e-5;

/// A working flank: involute helicoid minus a modification plus a manufacturing error, in the frame of its gear.
///
/// Frame: z along the gear axis, x towards the mate, y such that the flank's outward normal at the pitch point has a positive y
/// component; z = 0 at mid face. At rotation 0 the nominal flank of tooth 0 passes through the pitch point on the x axis. With the
/// roll length rho (transverse radius of curvature), e the radial and t the tangential unit vector at angle theta:
///
///     theta = origin + s z/p - rho/r_b,      point = r_b e(theta) + (rho - D) t(theta),
///     D = removal - added metal at r = sqrt(r_b^2 + rho^2), z      [mm, along the base tangent]
///
/// with s = +1 for a right-hand helix seen in this frame, -1 for left. D = 0 is the involute helicoid, e.g. TM-107451,
/// eq. A.1.1, with theta the negative of its theta_1 + mu_1.
struct InvoluteFlank {
  double base_radius{not_given};   ///< r_b [mm]
  double helix_rate{0.0};          ///< s/p, signed [rad/mm]
  double origin{not_given};        ///< theta of the involute's start in the section z = 0 at rotation 0 [rad]
  double form_radius{not_given};   ///< lower end of the flank [mm], >= r_b * lowest_start
  double tip_radius{not_given};    ///< upper end [mm]
  double half_face{not_given};     ///< b/2 [mm]
  FlankFrame frame;
  Modification modification;
  ManufacturingError error;

  double lowest_roll() const { return roll_at(form_radius); }
  double highest_roll() const { return roll_at(tip_radius); }
  double roll_at(double radius) const {
    return std::sqrt(std::max(0.0, (radius - base_radius) * (radius + base_radius)));
  }

  /// D of tooth `tooth` at roll length rho and axial position z [mm].
  template <class Scalar>
  Scalar deviation(const Scalar& rho, const Scalar& z, int tooth) const {
    using std::sqrt;
    const Scalar r = sqrt(rho * rho + base_radius * base_radius);
    return removal(modification, frame, r, z) - added_metal(error, frame, r, z) - pitch_deviation(error, tooth);
  }
};

/// A point of a flank or in space, Scalar double or Dual<N> [mm].
template <class Scalar>
struct Point3 {
  Scalar x, y, z;
};

/// Point of the flank turned by `rotation` [rad, counter-clockwise], in the gear's fixed frame [mm].
template <class Scalar>
Point3<Scalar> flank_point(const InvoluteFlank& flank, const Scalar& rho, const Scalar& z, int tooth, double rotation) {
  using std::cos;
  using std::sin;
  const Scalar theta = flank.origin + rotation + flank.helix_rate * z - rho / flank.base_radius;
  const Scalar along = rho - flank.deviation(rho, z, tooth);
  const Scalar c = cos(theta), s = sin(theta);
  return {flank.base_radius * c - along * s, flank.base_radius * s + along * c, z};
}

/// Rotation at which the flank passes through a given point of the gear's fixed frame, and the point's radius.
template <class Scalar>
struct FlankThroughPoint {
  Scalar rotation;  ///< [rad]
  Scalar radius;    ///< [mm]
};

/// Inverse of flank_point(): the rotation of the gear that puts its flank through `p`. Valid for points outside the base
/// cylinder and |dD/drho| < 1 (a flank that does not fold over itself).
template <class Scalar>
FlankThroughPoint<Scalar> rotation_through(const InvoluteFlank& flank, const Point3<Scalar>& p, int tooth) {
  using std::atan2;
  using std::sqrt;
  const double rb = flank.base_radius;
  const Scalar radius = sqrt(p.x * p.x + p.y * p.y);
  const Scalar along = sqrt((radius - rb) * (radius + rb));  // rho - D(rho, z)
  // Newton on rho - D(rho, z) = along; the last step is taken in Scalar arithmetic and carries the exact gradient.
  const double target = value_of(along), z = value_of(p.z);
  double rho = target;
  double slope = 1.0;
  for (int i = 0; i < 50; ++i) {
    const Dual<1> d = flank.deviation(Dual<1>::variable(rho, 0), Dual<1>(z), tooth);
    slope = 1.0 - d.gradient[0];
    const double step = (rho - d.value - target) / slope;
    rho -= step;
    if (std::abs(step) <= 1e-15 * (rho + rb)) break;
  }
  const Scalar rho_exact = rho - (rho - flank.deviation(Scalar(rho), p.z, tooth) - along) / slope;
  const Scalar theta = flank.origin + flank.helix_rate * p.z - rho_exact / rb;
  return {atan2(p.y, p.x) - atan2(along, Scalar(rb)) - theta, radius};
}

/// Flank of one gear of the pair in the canonical sense (pinion driving in +y); a left working flank is mirrored into it.
InvoluteFlank make_flank(const GearPair& pair, Member member, const Modification& modification,
                         const ManufacturingError& error);

}  // namespace flankwright
