#include "core/contact/gap/gap.hpp"

#include <cmath>

#include "core/contact/assembly/flank_assembly.hpp"
#include "core/contact/assembly/wheel_displacement.hpp"
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

const char* to_string(GapModel model) { return model == GapModel::PlaneOfAction ? "plane_of_action" : "whole_surface"; }

Gap plane_of_action_gap(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition) {
  const int n = static_cast<int>(points.size());
  const double arm = std::cos(pair.base_helix_angle) * pair.pinion.base_radius;
  const WheelDisplacement displacement(pair, condition.misalignment);
  const Flank nominal = make_flank(pair, Member::Pinion, {}, {});
  const Flank changed = assemble_flanks(pair, {.misalignment = condition.misalignment}).pinion;
  const bool is_nominal = condition.misalignment.pinion_lead_angle == 0.0 && condition.misalignment.pinion_pressure_angle == 0.0;
  Gap gap{Eigen::VectorXd(n), Eigen::VectorXd(n), FlankTouchSearch(pair, condition).at(points)};
  for (int i = 0; i < n; ++i) {
    const ContactPoint& point = points[i];
    const double opened = displacement.along_normal(point) - (is_nominal ? 0.0 : arm * pinion_lead(changed, nominal, point));
    gap.total[i] = gap.touches[i].gap + opened;
    gap.error[i] = point.clearance - gap.total[i];
  }
  return gap;
}

Eigen::VectorXd gap_derivative(const GearPair& pair, const std::vector<ContactPoint>& points, const Gap& gap, const FlankCondition& condition,
                               Member member, ModificationParameter parameter) {
  const TouchDerivative touches(pair, condition, member, parameter);
  Eigen::VectorXd derivative(points.size());
  for (Eigen::Index i = 0; i < derivative.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    derivative[i] = touches.of_gap(points[k], gap.touches[k]);
  }
  return derivative;
}

}  // namespace flankwright
