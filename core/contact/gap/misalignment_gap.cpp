#include "core/contact/gap/misalignment_gap.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/contact/assembly/wheel_displacement.hpp"
#include "core/contact/gap/flank_touch_search.hpp"

namespace flankwright {

namespace {

/// The step of central differences along the profile [m_n]. Round-off of a gap over it is 1e-10. Where contact comes to an edge the curvature of the gap
/// jumps: there half the step over a radius of curvature is off.
constexpr double profile_step = 1e-5;

/// d/dp of the angle by which the erroneous pinion's flank is ahead of the nominal one [1], chain rule over TM-107451,
/// A.2.1-A.2.8, with beta = helix angle - delta lambda and alpha_n = pressure angle + delta alpha:
///
///     lead = inv(alpha_t) + s tan(beta)/r_p z - inv(acos(r_b/r)) + const,   r_p = m_n N1/(2 cos beta),
///     tan(alpha_t) = tan(alpha_n)/cos(beta),   r_b = r_p cos(alpha_t);      d inv(a) = tan^2(a) da
class PinionLeadSlope {
 public:
  PinionLeadSlope(const GearPair& pair, const Misalignment& m, MisalignmentParameter parameter) {
    const double d_beta = parameter == &Misalignment::pinion_lead_angle ? -1.0 : 0.0;
    const double d_alpha_n = parameter == &Misalignment::pinion_pressure_angle ? 1.0 : 0.0;
    const double beta = pair.data.helix_angle - m.pinion_lead_angle, alpha_n = pair.data.pressure_angle + m.pinion_pressure_angle;
    const double cylinder = 0.5 * pair.data.normal_module * pair.data.pinion.teeth;  // r_p cos(beta)
    const double r_p = cylinder / std::cos(beta), tan_alpha = std::tan(alpha_n) / std::cos(beta);
    const double cos_alpha = 1.0 / std::sqrt(1.0 + tan_alpha * tan_alpha);
    const double d_tan_alpha = tan_alpha * std::tan(beta) * d_beta + d_alpha_n / (std::cos(alpha_n) * std::cos(alpha_n) * std::cos(beta));
    const double d_alpha = cos_alpha * cos_alpha * d_tan_alpha;
    const double sense = pair.contact_line_sense() == 0 ? 1.0 : pair.contact_line_sense();
    base_radius_ = r_p * cos_alpha;
    d_base_radius_ = base_radius_ * (std::tan(beta) * d_beta - tan_alpha * d_alpha);
    d_origin_ = tan_alpha * tan_alpha * d_alpha;
    d_helix_rate_ = sense * std::cos(beta) / cylinder * d_beta;
  }

  double at(const ContactPoint& point) const {
    // Inside the base circle, where the flank is taken to start at its cusp, the last term stays 0.
    const double outside = std::max(0.0, point.pinion_radius * point.pinion_radius - base_radius_ * base_radius_);
    const double tan_at_point = std::sqrt(outside) / base_radius_;
    return d_origin_ + d_helix_rate_ * point.z + tan_at_point * d_base_radius_ / base_radius_;
  }

 private:
  double base_radius_, d_base_radius_, d_origin_, d_helix_rate_;
};

}  // namespace

std::string_view name_of(MisalignmentParameter parameter) {
  return std::ranges::find(misalignment_parameters, parameter, &NamedMisalignmentParameter::parameter)->name;
}

MisalignmentSlopes misalignment_slopes(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition,
                                       MisalignmentParameter parameter) {
  const Misalignment& misalignment = condition.misalignment;
  if (parameter == &Misalignment::axial_offset) {
    throw InvalidInput("misalignment.axial_offset", "a derivative", "a parameter that leaves the contact points where they are");
  }
  const bool of_pinion = parameter == &Misalignment::pinion_lead_angle || parameter == &Misalignment::pinion_pressure_angle;
  Misalignment unit;
  unit.*parameter = 1.0;
  const WheelDisplacement displacement(pair, unit, misalignment.axial_offset);
  const PinionLeadSlope lead(pair, misalignment, parameter);
  const double arm = std::cos(pair.base_helix_angle) * pair.pinion.base_radius;
  MisalignmentSlopes slopes{Eigen::VectorXd(points.size()), Eigen::VectorXd::Zero(std::ssize(points))};
  double farthest = 0.0;  // along the profile, by the unit
  for (Eigen::Index i = 0; i < slopes.gap.size(); ++i) {
    const ContactPoint& point = points[static_cast<std::size_t>(i)];
    slopes.gap[i] = of_pinion ? -arm * lead.at(point) : displacement.along_normal(point);
    farthest = std::max(farthest, std::abs(displacement.along_profile(point.z)));
  }
  if (farthest == 0.0) return slopes;
  const double step = profile_step * pair.data.normal_module / farthest;
  const auto touches = [&](double by) {
    FlankCondition moved = condition;
    moved.misalignment.*parameter += by;
    return FlankTouchSearch(pair, moved).at(points);
  };
  const std::vector<FlankTouch> more = touches(step), less = touches(-step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    slopes.gap[k] += (more[i].gap - less[i].gap) / (2.0 * step);
    slopes.edge[k] = (edge_moved_by(points[i], more[i]) - edge_moved_by(points[i], less[i])) / (2.0 * step);
  }
  return slopes;
}

}  // namespace flankwright
