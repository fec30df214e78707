#include "core/contact/gap/plane_of_action_gap.hpp"

#include <cmath>

#include "core/contact/assembly/flank_assembly.hpp"
#include "core/gear/involute.hpp"

namespace flankwright {

namespace {

/// Angle by which the changed pinion flank is ahead of the nominal one at a point [rad].
double pinion_lead(const Flank& changed, const Flank& nominal, const ContactPoint& point) {
  const auto polar = [&](const Flank& flank) {
    const double cosine = std::min(1.0, flank.base_radius / point.pinion_radius);
    return flank.origin + flank.helix_rate * point.z - involute(std::acos(cosine));
  };
  return polar(changed) - polar(nominal);
}

}  // namespace

PlaneOfActionGap::PlaneOfActionGap(const GearPair& pair, const FlankCondition& condition)
    : pair_(pair), displacement_(pair, condition.misalignment), touches_(pair, condition) {
  if (condition.misalignment.pinion_lead_angle == 0.0 && condition.misalignment.pinion_pressure_angle == 0.0) return;
  pinion_ = {make_flank(pair, Member::Pinion, {}, {}), assemble_flanks(pair, {.misalignment = condition.misalignment}).pinion};
}

double PlaneOfActionGap::opened(const ContactPoint& point) const {
  const double by_wheel = displacement_.along_normal(point);
  if (!pinion_) return by_wheel;
  return by_wheel - std::cos(pair_.base_helix_angle) * pair_.pinion.base_radius * pinion_lead(pinion_->changed, pinion_->nominal, point);
}

Gap PlaneOfActionGap::at(const std::vector<ContactPoint>& points) const {
  const auto n = static_cast<Eigen::Index>(points.size());
  Gap gap{Eigen::VectorXd(n), Eigen::VectorXd(n), touches_.at(points)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    gap.total[i] = gap.touches[k].gap + opened(points[k]);
    gap.error[i] = points[k].clearance - gap.total[i];
  }
  return gap;
}

Gap plane_of_action_gap(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition) {
  return PlaneOfActionGap(pair, condition).at(points);
}

Eigen::VectorXd gap_derivative(const std::vector<ContactPoint>& points, const Gap& gap, const TouchDerivative& touches) {
  Eigen::VectorXd derivative(std::ssize(points));
  for (Eigen::Index i = 0; i < derivative.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    derivative[i] = touches.of_gap(points[k], gap.touches[k]);
  }
  return derivative;
}

}  // namespace flankwright
