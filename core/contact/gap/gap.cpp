#include "core/contact/gap/gap.hpp"

#include <cmath>

#include "core/contact/assembly/flank_assembly.hpp"
#include "core/contact/assembly/wheel_displacement.hpp"
#include "core/gear/involute.hpp"

namespace flankwright {

namespace {

double radius_of(const ContactPoint& point, Member m) { return m == Member::Pinion ? point.pinion_radius : point.wheel_radius; }

/// Axial position on the gear's own face: the wheel carries its flank along when it is displaced.
double own_z(const ContactPoint& point, Member m, const Misalignment& misalignment) {
  return m == Member::Pinion ? point.z : point.z - misalignment.axial_offset;
}

/// The flank with its predesigned parabola as the lag that it gives in the plane of action, see removal().
Flank flank_in_plane_of_action(const GearPair& pair, Member m, const FlankCondition& condition) {
  Modification modification = condition.modification[m];
  modification.parabolic_te = 0.0;
  Flank flank = make_flank(pair, m, modification, condition.error[m]);
  flank.modification.parabolic_te = condition.modification[m].parabolic_te;
  return flank;
}

/// Angle by which the changed pinion flank is ahead of the nominal one at a point [rad].
double pinion_lead(const Flank& changed, const Flank& nominal, const ContactPoint& point) {
  const auto polar = [&](const Flank& flank) {
    const double cosine = std::min(1.0, flank.base_radius / point.pinion_radius);
    return flank.origin + flank.helix_rate * point.z - involute(std::acos(cosine));
  };
  return polar(changed) - polar(nominal);
}

/// R cos(beta_b) times the sign of a flank's slope along its own radius in the gap's slope towards the edge, and what turns the one by the roll
/// length into one along the flank.
double weight_of_slope(const GearPair& pair, const ContactPoint& point, Member m) {
  return (m == point.tip_edge.gear ? 1.0 : -1.0) * point.relative_radius * std::cos(pair.base_helix_angle) * pair[m].base_radius /
         radius_of(point, m);
}

}  // namespace

const char* to_string(GapModel model) { return model == GapModel::PlaneOfAction ? "plane_of_action" : "whole_surface"; }

Gap plane_of_action_gap(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition) {
  const int n = static_cast<int>(points.size());
  const double cos_base_helix = std::cos(pair.base_helix_angle);
  const WheelDisplacement displacement(pair, condition.misalignment);
  const Flank pinion = flank_in_plane_of_action(pair, Member::Pinion, condition);
  const Flank wheel = flank_in_plane_of_action(pair, Member::Wheel, condition);
  const Flank nominal = make_flank(pair, Member::Pinion, {}, {});
  const Flank changed = assemble_flanks(pair, {.misalignment = condition.misalignment}).pinion;
  const bool is_nominal = condition.misalignment.pinion_lead_angle == 0.0 && condition.misalignment.pinion_pressure_angle == 0.0;
  Gap gap{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    const ContactPoint& point = points[i];
    double removed = 0.0;
    for (Member m : {Member::Pinion, Member::Wheel}) {
      const Flank& flank = m == Member::Pinion ? pinion : wheel;
      removed += flank.deviation(flank.roll_at(radius_of(point, m)), own_z(point, m, condition.misalignment), point.tooth);
    }
    gap.error[i] = -cos_base_helix * removed - displacement.along_normal(point) +
                   (is_nominal ? 0.0 : cos_base_helix * pair.pinion.base_radius * pinion_lead(changed, nominal, point));
    gap.total[i] = point.clearance - gap.error[i];
  }
  return gap;
}

Eigen::VectorXd gap_derivative(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition, Member member,
                               ModificationParameter parameter) {
  const double cos_base_helix = std::cos(pair.base_helix_angle);
  const RemovalDerivative removed = ground_derivative(pair, member, condition.modification[member], parameter);
  Eigen::VectorXd derivative(points.size());
  for (Eigen::Index i = 0; i < derivative.size(); ++i) {
    const ContactPoint& point = points[static_cast<std::size_t>(i)];
    derivative[i] = cos_base_helix * removed.at(radius_of(point, member), own_z(point, member, condition.misalignment));
  }
  return derivative;
}

TipEdgeShift::TipEdgeShift(const GearPair& pair, const FlankCondition& condition)
    : pair_(pair),
      misalignment_(condition.misalignment),
      flanks_{flank_in_plane_of_action(pair, Member::Pinion, condition), flank_in_plane_of_action(pair, Member::Wheel, condition)} {}

double TipEdgeShift::at(const ContactPoint& point) const {
  double shift = 0.0;
  if (point.tip_edge.radius == 0.0) return shift;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const Flank& flank = flanks_[m];
    const double radius = radius_of(point, m), roll = flank.roll_at(radius);
    if (roll == 0.0) continue;  // at the base circle the slope along the flank has no limit
    const Dual<1> deviation = flank.deviation(Dual<1>::variable(roll, 0), Dual<1>(own_z(point, m, misalignment_)), point.tooth);
    shift += weight_of_slope(pair_, point, m) * deviation.gradient[0] * radius / roll;
  }
  return shift;
}

Eigen::VectorXd tip_edge_shift_derivative(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition,
                                          Member member, ModificationParameter parameter) {
  const RemovalDerivative removed = ground_derivative(pair, member, condition.modification[member], parameter);
  const double step = 1e-3 * pair.data.normal_module;
  Eigen::VectorXd derivative = Eigen::VectorXd::Zero(std::ssize(points));
  for (Eigen::Index i = 0; i < derivative.size(); ++i) {
    const ContactPoint& point = points[static_cast<std::size_t>(i)];
    if (point.tip_edge.radius == 0.0) continue;
    const double radius = radius_of(point, member), z = own_z(point, member, condition.misalignment);
    const double slope = (removed.at(radius + step, z) - removed.at(radius - step, z)) / (2.0 * step);
    derivative[i] = weight_of_slope(pair, point, member) * slope;
  }
  return derivative;
}

}  // namespace flankwright
