#include "core/flank/removal.hpp"

namespace flankwright {

namespace {

/// Coefficient of the crowning of a part of the profile [1/mm]; of a part that is not there nothing is crowned.
double crowning(double amount, double extent) { return extent > 0.0 ? amount / (extent * extent) : 0.0; }

}  // namespace

FlankPolynomial::FlankPolynomial(const PolynomialAmounts& m, const ToothError& e, const FlankFrame& frame)
    : pitch_radius_(frame.pitch_radius),
      above_(crowning(m.addendum_crowning, frame.tip_radius - frame.pitch_radius)),
      below_(crowning(m.dedendum_crowning, frame.pitch_radius - frame.active_root_radius)) {
  const double per_width = 1.0 / frame.face_width, per_height = 1.0 / (frame.tip_radius - frame.active_root_radius);
  const double up = frame.pitch_radius - frame.reference_radius;  // from the origin of the errors' profile slope to y = 0
  const double error_slope = e.profile_slope * per_height, error_twist = e.twist * per_height * per_width;
  level_ = error_slope == 0.0 ? 0.0 : -error_slope * up;
  y_ = m.profile_slope * per_height - error_slope;
  z_ = (m.lead_slope - e.helix_slope) * per_width - (error_twist == 0.0 ? 0.0 : error_twist * up);
  yz_ = m.twist * per_height * per_width - error_twist;
  zz_ = 4.0 * m.lead_crowning * per_width * per_width;
}

RemovalDerivative::WithSlope RemovalDerivative::with_slope(double r, double z) const {
  if (as_drawn_) {
    const Jet unit = unit_.at(r, z);
    return {unit.value, unit.u};
  }
  const double step = 1e-5 * frame_.base_radius;
  return {shifted(r, z), (shifted(r + step, z) - shifted(r - step, z)) / (2.0 * step)};
}

}  // namespace flankwright
