#pragma once

#include <cmath>
#include <optional>
#include <tuple>

#include "core/base/dual.hpp"
#include "core/base/jet.hpp"
#include "core/flank/contact_shift.hpp"
#include "core/flank/manufacturing_error.hpp"
#include "core/flank/modifications/modification.hpp"

namespace flankwright {

/// The part of a flank's deviation that is polynomial on either side of the pitch circle, with everything constant over
/// the flank computed once: at radius r and axial position z [mm], transverse base tangent, positive into the tooth,
/// the modifications that name their part of PolynomialAmounts less
///
///     errors:   f_Hbeta z/b + f_Halpha y/h_active + f_yz (y/h_active)(z/b),   y = r - reference radius, h_active = r_a - r_Nf
///
/// Radial measure throughout, as Haddad 1991, eq. 6.1 (there with b^2 printed for (b/2)^2 in the crowning term).
class FlankPolynomial {
 public:
  FlankPolynomial(const PolynomialAmounts& amounts, const ToothError& error, const FlankFrame& frame);

  Jet at(double r, double z) const {
    const double y = r - pitch_radius_, crown = y > 0.0 ? above_ : below_;
    return {level_ + (y_ + yz_ * z + crown * y) * y + (z_ + zz_ * z) * z,
            y_ + yz_ * z + 2.0 * crown * y,
            z_ + 2.0 * zz_ * z + yz_ * y,
            2.0 * crown,
            yz_,
            2.0 * zz_};
  }

 private:
  double pitch_radius_;
  double level_, y_, z_, yz_, zz_;  ///< coefficients of 1, y, z, yz, z^2 with y = r - r_w
  double above_, below_;            ///< of y^2 above and below the pitch circle
};

namespace detail {

template <class M>
auto terms_of(const M& m, const FlankFrame& frame) {
  if constexpr (TermModification<M>) {
    return std::tuple<typename M::Term>(typename M::Term(m, frame));
  } else {
    return std::tuple<>();
  }
}

template <class M>
void add_polynomial(const M& m, PolynomialAmounts& sum) {
  if constexpr (PolynomialModification<M>) m.add_to(sum);
}

}  // namespace detail

/// The part of a flank's deviation in closed form: metal removed by the modifications of a list (without the grid
/// `topography`) less metal added by manufacturing errors, without pitch. The function is continuous; its slope jumps
/// where a linear relief starts. Outside the active flank the same formulas continue.
template <class List>
class DeviationFormulaOf;

template <class... M>
class DeviationFormulaOf<ModificationList<M...>> {
 public:
  DeviationFormulaOf(const ModificationList<M...>& m, const ToothError& error, const FlankFrame& frame)
      : polynomial_(amounts(m), error, frame), terms_(std::tuple_cat(detail::terms_of<M>(m, frame)...)) {}

  /// Value, first and second derivatives, u = r and v = z; at a relief's start those of the side without it.
  Jet at(double r, double z) const {
    Jet d = polynomial_.at(r, z);
    std::apply([&](const auto&... term) { (term.add(r, z, d), ...); }, terms_);
    return d;
  }

 private:
  static PolynomialAmounts amounts(const ModificationList<M...>& m) {
    PolynomialAmounts sum;
    (detail::add_polynomial<M>(m, sum), ...);
    return sum;
  }

  FlankPolynomial polynomial_;
  decltype(std::tuple_cat(detail::terms_of<M>(std::declval<const M&>(), std::declval<const FlankFrame&>())...)) terms_;
};

using DeviationFormula = DeviationFormulaOf<Modifications>;

/// Material that a modification asks to remove at r, z [mm], whatever its process makes of it: DeviationFormula without errors. Scalar is double, Dual<N> or Jet.
template <class Scalar>
Scalar removal(const Modifications& m, const FlankFrame& frame, const Scalar& r, const Scalar& z) {
  return chain(DeviationFormula(m, {}, frame).at(value_of(r), value_of(z)), r, z);
}

/// An amount of one parameter, by default a unit, with the extents of a modification: nothing else removes anything.
template <class List>
List unit_amount(const List& m, const DescriptorOf<List>& parameter, double amount = 1.0) {
  static constexpr auto all = descriptors_of(std::type_identity<List>());
  List unit = m;
  for (const DescriptorOf<List>& d : all) {
    if (d.slope == nullptr) d.set(unit, 0.0);
  }
  if (parameter.slope == nullptr) parameter.set(unit, amount);
  return unit;
}

/// Derivative of removal() with respect to one modification parameter [mm/mm; parabolic_te mm rad], exact; one-sided at
/// a relief's start. The part that does not depend on the point is computed once. With the shift of a process it is the derivative of what is ground: that
/// of a lead modification where the process takes it from.
template <class List>
class RemovalDerivativeOf {
 public:
  /// @param opposite  m is that of the opposite flank, see on_opposite_flank(), of which the parameter is asked for as its own flank has it
  RemovalDerivativeOf(const List& m, const FlankFrame& frame, const DescriptorOf<List>& parameter, const std::optional<ContactShift>& shift = {},
                      bool opposite = false)
      : m_(m),
        frame_(frame),
        slope_(parameter.slope),
        unit_(unit_amount(m, parameter, opposite && parameter.odd_along_face ? -1.0 : 1.0), {}, frame) {
    if (parameter.flank_class == ModificationClass::Lead) shift_ = shift;
    as_drawn_ = slope_ == nullptr && !shift_;
  }

  double at(double r, double z) const { return as_drawn_ ? unit_.at(r, z).value : shifted(r, z); }
  /// Whether a process moves it: it then depends on the roll length at r.
  bool is_shifted() const { return shift_.has_value(); }

 protected:
  double shifted(double r, double z) const {
    const double from = shift_ ? z - shift_->at_radius(r) : z;
    return slope_ == nullptr ? unit_.at(r, from).value : slope_(m_, frame_, r, from);
  }

  List m_;
  FlankFrame frame_;
  double (*slope_)(const List&, const FlankFrame&, double, double);
  DeviationFormulaOf<List> unit_;  ///< amounts enter linearly: the removal of a unit amount
  std::optional<ContactShift> shift_;
  bool as_drawn_;  ///< an amount that no process moves
};

class RemovalDerivative : public RemovalDerivativeOf<Modifications> {
 public:
  /// @param parameter  of what is removed; CompensationDerivative is that by the process'
  RemovalDerivative(const Modifications& m, const FlankFrame& frame, ModificationParameter parameter, const std::optional<ContactShift>& shift = {},
                    bool opposite = false)
      : RemovalDerivativeOf(m, frame, modification_parameters[static_cast<std::size_t>(parameter)], shift, opposite) {}

  struct WithSlope {
    double value, slope;
  };
  /// at() with its derivative by the radius, exact for amounts that no process moves, else by a central difference.
  WithSlope with_slope(double r, double z) const;
};
/// The same at one point.
inline double removal_derivative(const Modifications& m, const FlankFrame& frame, ModificationParameter parameter, double r, double z) {
  return RemovalDerivative(m, frame, parameter).at(r, z);
}

/// Metal added by one tooth's errors at r, z [mm], transverse base tangent [Haddad 1991, eq. 6.1], without pitch: the errors'
/// part of DeviationFormula with its sign turned.
template <class Scalar>
Scalar added_metal(const ToothError& e, const FlankFrame& frame, const Scalar& r, const Scalar& z) {
  return -chain(FlankPolynomial({}, e, frame).at(value_of(r), value_of(z)), r, z);
}

}  // namespace flankwright
