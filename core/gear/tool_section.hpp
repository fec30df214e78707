#pragma once

#include <cmath>

#include "core/gear/pair_geometry.hpp"
#include "core/gear/generation.hpp"

namespace flankwright {

/// A point of a generating tool in a transverse section of the gear, against the straight rack of the same pressure angle. With b
/// along the rack's straight profile towards the gear's tip, n its normal out of the tooth and the origin on the rolling line:
///
///     point = along b - depth n,        normal to the surface = n + slope b + lead_slope z
///
/// Scalar is double, Dual<N> or Jet.
template <class Scalar>
struct ToolPoint {
  Scalar along;       ///< xi [mm]
  Scalar depth;       ///< d, into the tooth [mm]
  Scalar slope;       ///< d(depth)/d(along) at constant z
  Scalar lead_slope;  ///< d(depth)/dz at constant along
};

/// Transverse section of the ParabolicRack by its parameter u: A.5.6 of TM-107451 with u against the paper's direction, and
/// divided by cos(beta) across the tooth. The same in every z.
class ParabolicSection {
 public:
  ParabolicSection(const ParabolicRack& tool, const PairData& pair);

  template <class Scalar>
  ToolPoint<Scalar> at(const Scalar& u, const Scalar&) const {
    return {u * (stretch_ + bend_ * u), curvature_ * u * u, 2.0 * curvature_ * u / (stretch_ + 2.0 * bend_ * u), 0.0};
  }

  /// The parameter near which the section reaches `along`: exact for the straight rack.
  double guess(double along, double) const { return along / stretch_; }

 private:
  double curvature_;       ///< a_c / cos(beta_b) [1/mm]
  double stretch_, bend_;  ///< along = stretch u + bend u^2; 1 and 0 for spur gears
};

/// Section of the RevolutionTool by the arc length t of its generatrix: TM-100260, eqs 13-18, with theta_p eliminated by
/// R sin(theta_p) = z, the origin at the pitch point and beta = t / rho. R is the radius of the tool's circle through t:
///
///     xi = xi_0 + s sin(alpha),    d = d_0 + s cos(alpha),    s = R - sqrt(R^2 - z^2)
///
/// with xi_0 = rho sin(beta) and d_0 = rho (1 - cos(beta)) on the generatrix itself. NaN where |z| > R.
///
/// The apex lies beyond the gear's tip, a_1 from the rolling line along the generatrix. The paper gives only a_1 + a_2 =
/// d / cos(alpha); here the rim reaches as deep as the tip of the gear's rack, a_2 = (h_fP - x_E m_n) / cos(alpha_n).
class RevolutionSection {
 public:
  RevolutionSection(const RevolutionTool& tool, const PairData& pair, const GearData& gear);

  template <class Scalar>
  ToolPoint<Scalar> at(const Scalar& t, const Scalar& z) const {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const Scalar sin_half = sin(0.5 * curvature_ * t), cos_half = cos(0.5 * curvature_ * t);
    const Scalar chord = curvature_ == 0.0 ? t : 2.0 / curvature_ * sin_half;
    const Scalar sin_beta = 2.0 * sin_half * cos_half, cos_beta = 1.0 - 2.0 * sin_half * sin_half;
    const Scalar along = chord * cos_half, depth = chord * sin_half;
    const Scalar radius = (apex_distance_ - along) * sin_ - depth * cos_;
    const Scalar sagitta = z * z / (radius + sqrt((radius - z) * (radius + z)));
    // Normal (cos(alpha + beta) cos(theta_p), sin(alpha + beta), cos(alpha + beta) sin(theta_p)), turned by alpha.
    const Scalar radial = (cos_ * cos_beta - sin_ * sin_beta) / radius;
    const Scalar n = cos_beta - radial * sagitta * cos_;
    const Scalar b = sin_beta + radial * sagitta * sin_;
    return {along + sagitta * sin_, depth + sagitta * cos_, b / n, radial * z / n};
  }

  /// The parameter near which the section reaches `along`: exact for the plane's tangent circle. NaN where the tool's circle there
  /// is too small.
  double guess(double along, double z) const {
    const double radius = (apex_distance_ - along) * sin_;
    return along - sin_ * z * z / (radius + std::sqrt((radius - z) * (radius + z)));
  }

  double apex_distance() const { return apex_distance_; }  ///< a_1 [mm]

 private:
  double sin_, cos_;      ///< of alpha
  double apex_distance_;  ///< a_1 [mm]
  double curvature_;      ///< 1/rho [1/mm]
};

}  // namespace flankwright
