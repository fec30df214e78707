#include "core/flank/removal.hpp"

#include <algorithm>

namespace flankwright {

namespace {

/// Coefficient of the crowning of a part of the profile [1/mm]; of a part that is not there nothing is crowned.
double crowning(double amount, double extent) { return extent > 0.0 ? amount / (extent * extent) : 0.0; }

/// amount/extent^power, 0 for no amount, whose extent may be missing.
double per_extent(double amount, double extent, int power) {
  if (amount == 0.0) return 0.0;
  return power == 1 ? amount / extent : amount / (extent * extent);
}

struct Polynomial {
  double value, first, second;
};

/// P_0 .. P_4 with their derivatives.
std::array<Polynomial, 5> legendre(double x) {
  const double x2 = x * x;
  return {{{1.0, 0.0, 0.0},
           {x, 1.0, 0.0},
           {0.5 * (3.0 * x2 - 1.0), 3.0 * x, 3.0},
           {0.5 * x * (5.0 * x2 - 3.0), 1.5 * (5.0 * x2 - 1.0), 15.0 * x},
           {0.125 * ((35.0 * x2 - 30.0) * x2 + 3.0), 2.5 * x * (7.0 * x2 - 3.0), 7.5 * (7.0 * x2 - 1.0)}}};
}

/// A unit amount of one parameter with the extents of a modification; nothing for an extent.
Modification unit_amount(const Modification& m, ModificationParameter parameter) {
  Modification unit;
  unit.tip_relief = {0.0, m.tip_relief.height, m.tip_relief.shape};
  unit.root_relief = {0.0, m.root_relief.height, m.root_relief.shape};
  unit.end_relief = {0.0, m.end_relief.length};
  const bool extent = parameter == ModificationParameter::TipReliefHeight || parameter == ModificationParameter::RootReliefHeight ||
                      parameter == ModificationParameter::EndReliefLength;
  if (!extent) set(unit, parameter, 1.0);
  return unit;
}

}  // namespace

DeviationFormula::DeviationFormula(const Modification& m, const ToothError& e, const FlankFrame& frame)
    : pitch_radius_(frame.pitch_radius),
      above_(crowning(m.addendum_crowning, frame.tip_radius - frame.pitch_radius)),
      below_(crowning(m.dedendum_crowning, frame.pitch_radius - frame.active_root_radius)),
      tip_(relief(m.tip_relief.amount, m.tip_relief.height, m.tip_relief.shape, frame.tip_radius - m.tip_relief.height)),
      root_(relief(m.root_relief.amount, m.root_relief.height, m.root_relief.shape,
                   frame.active_root_radius + m.root_relief.height)),
      end_(relief(m.end_relief.amount, m.end_relief.length, ReliefShape::Linear,
                  0.5 * frame.face_width - m.end_relief.length)),
      parabola_(m.parabolic_te == 0.0
                    ? 0.0 : frame.wheel_base_radius * m.parabolic_te * frame.pinion_turn * frame.pinion_turn),
      base_radius_(frame.base_radius),
      pitch_roll_(frame.pitch_roll),
      helix_rate_(frame.helix_rate),
      has_shapes_(std::ranges::any_of(m.shapes, [](double c) { return c != 0.0; })),
      shapes_(m.shapes),
      middle_radius_(0.5 * (frame.tip_radius + frame.active_root_radius)),
      half_height_(0.5 * (frame.tip_radius - frame.active_root_radius)),
      half_face_(0.5 * frame.face_width) {
  const double per_width = 1.0 / frame.face_width, per_height = 1.0 / (frame.tip_radius - frame.active_root_radius);
  const double up = frame.pitch_radius - frame.reference_radius;  // from the origin of the errors' profile slope to y = 0
  const double error_slope = e.profile_slope * per_height, error_twist = e.twist * per_height * per_width;
  level_ = error_slope == 0.0 ? 0.0 : -error_slope * up;
  y_ = m.profile_slope * per_height - error_slope;
  z_ = (m.lead_slope - e.helix_slope) * per_width - (error_twist == 0.0 ? 0.0 : error_twist * up);
  yz_ = m.twist * per_height * per_width - error_twist;
  zz_ = 4.0 * m.lead_crowning * per_width * per_width;
}

DeviationFormula::Relief DeviationFormula::relief(double amount, double extent, ReliefShape shape, double start) {
  return shape == ReliefShape::Linear ? Relief{start, per_extent(amount, extent, 1), 0.0}
                                      : Relief{start, 0.0, per_extent(amount, extent, 2)};
}

void DeviationFormula::add_parabola(double r, double z, Jet& d) const {
  const double rho = std::sqrt((r - base_radius_) * (r + base_radius_)), k = parabola_;
  const double turn = (rho - pitch_roll_) / base_radius_ - helix_rate_ * z;  // of the gear itself
  const double turn_r = r / (rho * base_radius_), turn_rr = -base_radius_ / (rho * rho * rho);
  d.value += k * turn * turn;
  d.u += 2.0 * k * turn * turn_r;
  d.v -= 2.0 * k * turn * helix_rate_;
  d.uu += 2.0 * k * (turn_r * turn_r + turn * turn_rr);
  d.uv -= 2.0 * k * turn_r * helix_rate_;
  d.vv += 2.0 * k * helix_rate_ * helix_rate_;
}

void DeviationFormula::add_shapes(double r, double z, Jet& d) const {
  const auto profile = legendre((r - middle_radius_) / half_height_), face = legendre(z / half_face_);
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    const Polynomial& p = profile[static_cast<std::size_t>(topography_shapes[k].profile)];
    const Polynomial& f = face[static_cast<std::size_t>(topography_shapes[k].face)];
    d.value += shapes_[k] * p.value * f.value;
    d.u += shapes_[k] * p.first * f.value / half_height_;
    d.v += shapes_[k] * p.value * f.first / half_face_;
    d.uu += shapes_[k] * p.second * f.value / (half_height_ * half_height_);
    d.uv += shapes_[k] * p.first * f.first / (half_height_ * half_face_);
    d.vv += shapes_[k] * p.value * f.second / (half_face_ * half_face_);
  }
}

RemovalDerivative::RemovalDerivative(const Modification& m, const FlankFrame& frame, ModificationParameter parameter)
    : unit_(unit_amount(m, parameter), {}, frame), parameter_(parameter), tip_(m.tip_relief), root_(m.root_relief),
      end_(m.end_relief), frame_(frame) {}

double RemovalDerivative::at(double r, double z) const {
  const auto extent = [](double amount, double height, ReliefShape shape, double beyond_start) {
    // t = 1 - d/h with d the distance from the end of the relief: dt/dh = d/h^2 = (1 - t)/h.
    if (amount == 0.0 || beyond_start <= 0.0) return 0.0;
    const double t = beyond_start / height;
    const double slope = amount * (1.0 - t) / height;
    return shape == ReliefShape::Linear ? slope : 2.0 * t * slope;
  };
  switch (parameter_) {
    case ModificationParameter::TipReliefHeight:
      return extent(tip_.amount, tip_.height, tip_.shape, r - (frame_.tip_radius - tip_.height));
    case ModificationParameter::RootReliefHeight:
      return extent(root_.amount, root_.height, root_.shape, frame_.active_root_radius + root_.height - r);
    case ModificationParameter::EndReliefLength:
      return extent(end_.amount, end_.length, ReliefShape::Linear, std::abs(z) - (0.5 * frame_.face_width - end_.length));
    default: return unit_.at(r, z).value;
  }
}

}  // namespace flankwright
