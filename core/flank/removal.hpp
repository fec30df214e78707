#pragma once

#include <array>
#include <cmath>

#include "core/base/dual.hpp"
#include "core/base/jet.hpp"
#include "core/gear/microgeometry.hpp"

namespace flankwright {

/// What of a flank's deviation is a formula, all that is constant over the flank worked out once: metal removed by the modification
/// (its grid `topography` not included) less metal added by manufacturing errors, without pitch. At radius r and axial
/// position z [mm], transverse base tangent, positive into the tooth:
///
///     lead:     C_beta (2z/b)^2 + C_Hbeta z/b
///     profile:  C_a ((r - r_w)/(r_a - r_w))^2 above, C_f ((r_w - r)/(r_w - r_Nf))^2 below the pitch circle r_w,
///               C_Halpha (r - r_w)/(r_a - r_Nf);    no crowning above where r_a <= r_w, none below where r_Nf >= r_w (all contact on one
///               side of the pitch point)
///     reliefs:  C_tip  t or t^2,  t = (r - (r_a - h))/h where t > 0;    root likewise from r_Nf + h downwards;
///               C_end (|z| - (b/2 - l))/l where that is positive
///     twist:    S (r - r_w)/(r_a - r_Nf) z/b
///     parabolic TE:  r_b2 a phi1^2,  phi1 = i ((rho - rho_w)/r_b - s z/p)  with i = 1 (pinion) or -N2/N1 (wheel): the pinion angle
///               at which the undisturbed flanks touch along the line through (rho, z), the same along that whole line. It is how
///               far the mesh lags there; the flank that makes it do so is make_conjugate_field()
///     shapes:   sum of c_ij P_i((2 r - r_a - r_Nf)/(r_a - r_Nf)) P_j(2z/b)  (topography_shapes)
///     errors:   -(f_Hbeta z/b + f_Halpha y/h_active + f_yz (y/h_active)(z/b)),   y = r - reference radius, h_active = r_a - r_Nf
///
/// Radial measure throughout, as Haddad 1991, eq. 6.1 (there with b^2 printed for (b/2)^2 in the crowning term). The function
/// is continuous; its slope jumps where a linear relief starts. Outside the active flank the same formulas continue.
class DeviationFormula {
 public:
  DeviationFormula(const Modification& modification, const ToothError& error, const FlankFrame& frame);

  /// Value, first and second derivatives, u = r and v = z; at a relief's start those of the side without it.
  Jet at(double r, double z) const {
    const double y = r - pitch_radius_, crown = y > 0.0 ? above_ : below_;
    Jet d{level_ + (y_ + yz_ * z + crown * y) * y + (z_ + zz_ * z) * z,
          y_ + yz_ * z + 2.0 * crown * y, z_ + 2.0 * zz_ * z + yz_ * y, 2.0 * crown, yz_, 2.0 * zz_};
    tip_.add(r - tip_.start, 1.0, d.value, d.u, d.uu);
    root_.add(root_.start - r, -1.0, d.value, d.u, d.uu);
    end_.add(std::abs(z) - end_.start, z < 0.0 ? -1.0 : 1.0, d.value, d.v, d.vv);
    if (parabola_ != 0.0) add_parabola(r, z, d);
    if (has_shapes_) add_shapes(r, z, d);
    return d;
  }

 private:
  /// amount t or t^2 from `start` on, in one direction.
  struct Relief {
    double start{0.0}, linear{0.0}, quadratic{0.0};  ///< [mm], [mm/mm], [mm/mm^2]

    void add(double beyond, double sense, double& value, double& first, double& second) const {
      if (!(beyond > 0.0) || (linear == 0.0 && quadratic == 0.0)) return;
      value += (linear + quadratic * beyond) * beyond;
      first += sense * (linear + 2.0 * quadratic * beyond);
      second += 2.0 * quadratic;
    }
  };

  static Relief relief(double amount, double extent, ReliefShape shape, double start);
  void add_parabola(double r, double z, Jet& d) const;
  void add_shapes(double r, double z, Jet& d) const;

  double pitch_radius_;
  double level_, y_, z_, yz_, zz_;  ///< coefficients of 1, y, z, yz, z^2 with y = r - r_w
  double above_, below_;            ///< of y^2 above and below the pitch circle
  Relief tip_, root_, end_;
  double parabola_;  ///< r_b2 a i^2, see above [mm]
  double base_radius_, pitch_roll_, helix_rate_;
  bool has_shapes_;
  std::array<double, topography_shapes.size()> shapes_;
  double middle_radius_, half_height_, half_face_;  ///< what xi and eta count from and in
};

/// Material removed by a modification at r, z [mm]: DeviationFormula without errors. Scalar is double, Dual<N> or Jet.
template <class Scalar>
Scalar removal(const Modification& m, const FlankFrame& frame, const Scalar& r, const Scalar& z) {
  return chain(DeviationFormula(m, {}, frame).at(value_of(r), value_of(z)), r, z);
}

/// Derivative of removal() with respect to one modification parameter [mm/mm; parabolic_te mm rad], exact; one-sided at a relief's
/// start. What does not depend on the place is worked out once.
class RemovalDerivative {
 public:
  RemovalDerivative(const Modification& m, const FlankFrame& frame, ModificationParameter parameter);
  double at(double r, double z) const;

 private:
  DeviationFormula unit_;  ///< amounts enter linearly: the removal of a unit amount with the same extents
  ModificationParameter parameter_;
  ProfileRelief tip_, root_;
  EndRelief end_;
  FlankFrame frame_;
};
/// The same at one place.
inline double removal_derivative(const Modification& m, const FlankFrame& frame, ModificationParameter parameter, double r, double z) {
  return RemovalDerivative(m, frame, parameter).at(r, z);
}

/// Metal added by one tooth's errors at r, z [mm], transverse base tangent [Haddad 1991, eq. 6.1], without pitch: the errors'
/// part of DeviationFormula with its sign turned.
template <class Scalar>
Scalar added_metal(const ToothError& e, const FlankFrame& frame, const Scalar& r, const Scalar& z) {
  return -chain(DeviationFormula({}, e, frame).at(value_of(r), value_of(z)), r, z);
}

}  // namespace flankwright
