#pragma once

#include <cmath>

#include "core/base/dual.hpp"
#include "core/gear/microgeometry.hpp"

namespace flankwright {

/// Material removed from a flank at radius r and axial position z [mm], transverse base tangent, positive into the tooth:
/// the sum of all parts of the modification.
///
///     lead:     C_beta (2z/b)^2 + C_Hbeta z/b
///     profile:  C_a ((r - r_w)/(r_a - r_w))^2 above, C_f ((r_w - r)/(r_w - r_Nf))^2 below the pitch circle r_w,
///               C_Halpha (r - r_w)/(r_a - r_Nf)
///     reliefs:  C_tip  t or t^2,  t = (r - (r_a - h))/h where t > 0;    root likewise from r_Nf + h downwards;
///               C_end (|z| - (b/2 - l))/l where that is positive
///     twist:    S (r - r_w)/(r_a - r_Nf) z/b
///     parabolic TE:  r_b2 a phi1^2,  phi1 = i ((rho - rho_w)/r_b - s z/p)  with i = 1 (pinion) or -N2/N1 (wheel): the pinion angle
///               at which the undisturbed flanks touch along the line through (rho, z), the same along that whole line. It is how
///               far the mesh lags there; the flank that makes it do so is make_conjugate_field()
///
/// Radial measure throughout, as Haddad 1991, eq. 6.1 (there with b^2 printed for (b/2)^2 in the crowning term). The function
/// is continuous; its slope jumps where a linear relief starts. Outside the active flank the same formulas continue.
/// The grid `topography` is not part of it. Scalar is double, Dual<N> or Jet.
template <class Scalar>
Scalar removal(const Modification& m, const FlankFrame& frame, const Scalar& r, const Scalar& z) {
  const double b = frame.face_width;
  const double h_active = frame.tip_radius - frame.active_root_radius;
  const Scalar y = r - frame.pitch_radius;
  const Scalar along = z / b;
  Scalar c = 4.0 * m.lead_crowning * along * along + m.lead_slope * along +
             (m.profile_slope + m.twist * along) * y / h_active;
  const bool above = value_of(y) > 0.0;
  const double crowning = above ? m.addendum_crowning : m.dedendum_crowning;
  if (crowning != 0.0) {
    const double h = above ? frame.tip_radius - frame.pitch_radius : frame.pitch_radius - frame.active_root_radius;
    c += crowning * (y / h) * (y / h);
  }
  const auto relieve = [&c](double amount, double extent, ReliefShape shape, const Scalar& beyond_start) {
    if (amount == 0.0 || value_of(beyond_start) <= 0.0) return;
    const Scalar t = beyond_start / extent;
    c += amount * (shape == ReliefShape::Linear ? t : t * t);
  };
  relieve(m.tip_relief.amount, m.tip_relief.height, m.tip_relief.shape, r - (frame.tip_radius - m.tip_relief.height));
  relieve(m.root_relief.amount, m.root_relief.height, m.root_relief.shape,
          frame.active_root_radius + m.root_relief.height - r);
  relieve(m.end_relief.amount, m.end_relief.length, ReliefShape::Linear,
          (value_of(z) < 0.0 ? -z : z) - (0.5 * b - m.end_relief.length));
  if (m.parabolic_te != 0.0) {
    using std::sqrt;
    const Scalar rho = sqrt((r - frame.base_radius) * (r + frame.base_radius));
    const Scalar phi1 = frame.pinion_turn * ((rho - frame.pitch_roll) / frame.base_radius - frame.helix_rate * z);
    c += frame.wheel_base_radius * m.parabolic_te * phi1 * phi1;
  }
  return c;
}

/// Derivative of removal() with respect to one modification parameter [mm/mm; parabolic_te mm rad], exact; one-sided at a relief's start.
double removal_derivative(const Modification& m, const FlankFrame& frame, ModificationParameter parameter, double r, double z);

/// Metal added by manufacturing errors at r, z [mm], transverse base tangent [Haddad 1991, eq. 6.1], without pitch.
///
///     f_Hbeta z/b + f_Halpha y/h_active + f_yz (y/h_active)(z/b),   y = r - reference radius
template <class Scalar>
Scalar added_metal(const ManufacturingError& e, const FlankFrame& frame, const Scalar& r, const Scalar& z) {
  const Scalar along = z / frame.face_width;
  const Scalar up = (r - frame.reference_radius) / (frame.tip_radius - frame.active_root_radius);
  return e.helix_slope * along + e.profile_slope * up + e.twist * up * along;
}

/// Cumulative pitch deviation of tooth k [mm], see ManufacturingError.
double pitch_deviation(const ManufacturingError& error, int tooth);

}  // namespace flankwright
