#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/dual.hpp"
#include "core/base/jet.hpp"
#include "core/flank/natural_twist.hpp"
#include "core/flank/removal.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// At the base circle the involute ends in a cusp without a normal, where any removal folds the flank over itself. A flank is
/// taken to start at this multiple of r_b at least, at a roll length of r_b/100: form_radius >= r_b * lowest_start.
inline constexpr double lowest_start = 1.0 + 5e-5;

/// A working flank in the frame of its gear: an involute helicoid displaced along its transverse base tangents by how it was
/// generated, modified, measured and made wrong. Every flank is of this one form.
///
/// Frame: z along the gear axis, x towards the mate, y such that the flank's outward normal at the pitch point has a positive y
/// component; z = 0 at mid face. At rotation 0 the nominal flank of tooth 0 passes through the pitch point on the x axis. With the
/// roll length rho (transverse radius of curvature), e the radial and t the tangential unit vector at angle theta:
///
///     theta = origin + s z/p - rho/r_b,      point = r_b e(theta) + (rho - D) t(theta),
///     D = generation + removal + natural twist + parabola + topography - added metal - pitch at r = sqrt(r_b^2 + rho^2), z      [mm, + into the tooth]
///
/// with s = +1 for a right-hand helix seen in this frame, -1 for left. D = 0 is the involute helicoid, e.g. TM-107451,
/// eq. A.1.1, with theta the negative of its theta_1 + mu_1. The parameter rectangle is lowest_roll() .. highest_roll() by
/// face.begin .. face.end.
struct Flank {
  double base_radius{not_given};  ///< r_b [mm]
  double helix_rate{0.0};         ///< s/p, signed [rad/mm]
  double origin{not_given};       ///< theta of the involute's start in the section z = 0 at rotation 0 [rad]
  double form_radius{not_given};  ///< lower end of the flank [mm], >= r_b * lowest_start
  double tip_radius{not_given};   ///< upper end [mm]
  FaceRange face;                 ///< z of both ends of the flank
  FlankFrame frame;
  Modification modification;  ///< without what became a field
  ManufacturingError error;
  /// The sum of the other deviations: generated flank, predesigned parabola, measured grid, natural twist.
  std::vector<std::shared_ptr<const DeviationField>> fields;

  double lowest_roll() const { return roll_at(form_radius); }
  double highest_roll() const { return roll_at(tip_radius); }
  double roll_at(double radius) const { return std::sqrt(std::max(0.0, (radius - base_radius) * (radius + base_radius))); }

  /// D of tooth `tooth` at roll length rho and axial position z [mm]. A ToothDeviation is faster for many points.
  template <class Scalar>
  Scalar deviation(const Scalar& rho, const Scalar& z, int tooth) const;
};

/// The deviation of one tooth's flank; what is constant over the flank is computed once.
class ToothDeviation {
 public:
  /// @param flank  must outlive this
  ToothDeviation(const Flank& flank, int tooth)
      : flank_(flank),
        formula_(flank.modification, tooth_error(flank.error, tooth), flank.frame),
        measured_(tooth_topography(flank.error, tooth)),
        pitch_(pitch_deviation(flank.error, tooth)) {}

  /// D at roll length rho and axial position z [mm].
  template <class Scalar>
  Scalar value(const Scalar& rho, const Scalar& z) const {
    using std::sqrt;
    const Scalar r = sqrt(rho * rho + flank_.base_radius * flank_.base_radius);
    Scalar d = chain(formula_.at(value_of(r), value_of(z)), r, z) - pitch_;
    each_field([&](const DeviationField& field) { d += evaluate(field, rho, z); });
    return d;
  }

  /// D with its first and second derivative by the arc length of the involute, towards the tip [mm, -, 1/mm].
  struct AlongProfile {
    double value{0.0}, slope{0.0}, curvature{0.0};
  };
  /// With s the arc, r dr = rho drho = r_b ds. At the base circle, where fields have no slope, theirs is left out.
  AlongProfile at(double radius, double z) const;

 private:
  template <class Visit>
  void each_field(const Visit& visit) const {
    for (const auto& field : flank_.fields) visit(*field);
    if (measured_ != nullptr) visit(*measured_);
  }

  const Flank& flank_;
  DeviationFormula formula_;
  const DeviationField* measured_;
  double pitch_;
};

template <class Scalar>
Scalar Flank::deviation(const Scalar& rho, const Scalar& z, int tooth) const {
  return ToothDeviation(*this, tooth).value(rho, z);
}

/// A point of a flank or in space, Scalar double, Dual<N> or Jet [mm].
template <class Scalar>
struct Point3 {
  Scalar x, y, z;
};

/// Point of the flank turned by `rotation` [rad, counter-clockwise], in the gear's fixed frame [mm].
template <class Scalar>
Point3<Scalar> flank_point(const Flank& flank, const Scalar& rho, const Scalar& z, int tooth, double rotation) {
  using std::cos;
  using std::sin;
  const Scalar theta = flank.origin + rotation + flank.helix_rate * z - rho / flank.base_radius;
  const Scalar along = rho - flank.deviation(rho, z, tooth);
  const Scalar c = cos(theta), s = sin(theta);
  return {flank.base_radius * c - along * s, flank.base_radius * s + along * c, z};
}

/// A flank at one point of its parameter rectangle, in its gear's frame: position, unit normal out of the tooth, and first and
/// second derivatives of the position with respect to u = rho and v = z [mm], exact.
struct SurfacePoint {
  Eigen::Vector3d position, normal;
  Eigen::Vector3d d_rho, d_z;
  Eigen::Vector3d d_rho_rho, d_rho_z, d_z_z;
};

/// The flank of tooth `tooth` at (rho, z), turned by `rotation` [rad, counter-clockwise]. Valid where the flank does not fold
/// over itself (|dD/drho| < 1).
SurfacePoint surface_point(const Flank& flank, double rho, double z, int tooth, double rotation);

/// Rotation at which the flank passes through a given point of the gear's fixed frame, and the point's radius.
template <class Scalar>
struct FlankThroughPoint {
  Scalar rotation;  ///< [rad]
  Scalar radius;    ///< [mm]
};

/// Inverse of flank_point(): the rotation of the gear that puts its flank through `p`. Valid for points outside the base
/// cylinder and |dD/drho| < 1 (a flank that does not fold over itself).
template <class Scalar>
FlankThroughPoint<Scalar> rotation_through(const Flank& flank, const Point3<Scalar>& p, int tooth) {
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
/// The predesigned parabola becomes the flank that has it exactly (make_conjugate_field); what the process does to the lead modifications is added to it
/// (make_natural_twist_field).
/// @throws InvalidInput "parabolic_te" where no flank has that parabola; "grinding_wheel_diameter" for a form wheel that does not fit
Flank make_flank(const GearPair& pair, Member member, const Modification& modification, const ManufacturingError& error);

/// Derivative of a flank's deviation, as make_flank() has it, by one parameter of its modification or of its process. What the process does to lead
/// modifications is in it.
class GroundDerivative {
 public:
  using Kind = std::variant<RemovalDerivative, CompensationDerivative>;
  explicit GroundDerivative(Kind kind) : kind_(std::move(kind)) {}

  /// At radius r and axial position z [mm/mm; parabolic_te mm rad; twist_compensation mm].
  double at(double r, double z) const {
    return std::visit([&](const auto& derivative) { return derivative.at(r, z); }, kind_);
  }
  /// at() with its derivative by the radius, see RemovalDerivative and CompensationDerivative.
  RemovalDerivative::WithSlope with_slope(double r, double z) const {
    return std::visit([&](const auto& derivative) { return derivative.with_slope(r, z); }, kind_);
  }
  /// Whether it depends on the roll length at r.
  bool is_shifted() const {
    return std::visit([](const auto& derivative) { return derivative.is_shifted(); }, kind_);
  }

 private:
  Kind kind_;
};

/// @param opposite  by the parameter as the opposite flank has it, see on_opposite_flank(); a compensation is the same number on both
/// @throws InvalidInput "grinding_wheel_diameter" for a form wheel that does not fit
GroundDerivative ground_derivative(const GearPair& pair, Member member, const Modification& modification, ModificationParameter parameter,
                                   bool opposite = false);

}  // namespace flankwright
