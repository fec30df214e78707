#include "core/contact/gap/surface_gap.hpp"

#include <cmath>
#include <optional>

#include "core/contact/gap/flank_touch_search.hpp"
#include "core/contact/path/passed_edge.hpp"

namespace flankwright {

SurfaceGap::SurfaceGap(const GearPair& pair, const FlankCondition& condition)
    : pair_(pair), condition_(condition), assembly_(assemble_flanks(pair, condition)), density_(search_density(assembly_)) {
  for (Member m : {Member::Pinion, Member::Wheel}) {
    const double coefficient = condition.modification[m].parabolic_te;
    if (coefficient != 0.0) parabola_[static_cast<std::size_t>(m)] = make_conjugate_field(pair, m, coefficient);
  }
}

std::vector<SectionMaximum> SurfaceGap::maxima(const std::vector<ContactPoint>& points, double line_phase) const {
  const double phi1 = PathOfContact(pair_).pinion_angle_at(line_phase, pair_);
  std::vector<SectionMaximum> found;
  found.reserve(points.size());
  std::optional<ContactCondition> contact_condition;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool same_tooth = i > 0 && points[i].tooth == points[i - 1].tooth;
    if (!same_tooth) contact_condition.emplace(assembly_, points[i].tooth, phi1);
    const SectionSearch search(*contact_condition, density_.cells);
    SectionMaximum best = search.at(points[i].z, same_tooth ? found.back() : SectionMaximum{}, SectionAccuracy::Full);
    if (!best.exists) {
      best.at = contact_condition->at(assembly_.pinion.roll_at(points[i].pinion_radius), points[i].z);
      best.phi2 = contact_condition->phi2(best.at);
      best.slope_phi1 = best.at.angle.phi1;
    }
    found.push_back(best);
  }
  return found;
}

/// Removal from the pinion moves its point like a turn backwards by D/r_b1 and, with the slope of D, a step along the
/// profile: per unit of D, 1/(1 - D') of either. Removal from the wheel lets it turn on by D/r_b2 times its speed.
NearestPoint SurfaceGap::nearest_point(const SectionMaximum& found, int tooth) const {
  const Flank &pinion = assembly_.pinion, &wheel = assembly_.wheel;
  const double scale = wheel.base_radius * std::cos(pair_.base_helix_angle);
  const bool on_wheel_circle = found.bound == SectionBound::WheelTip || found.bound == SectionBound::WheelRoot;
  const auto side = [&](const Touch& touch, double share) {
    // On a circle of the wheel the point slides along it: that is in the slope of the path already.
    const double turning = on_wheel_circle ? found.slope_phi1 : touch.slope_phi1;
    const double stepping = on_wheel_circle ? 0.0 : touch.slope_rho;
    const Dual<1> removed = pinion.deviation(Dual<1>::variable(touch.rho, 0), Dual<1>(touch.z), tooth);
    const double by_pinion = (turning / pinion.base_radius + stepping) / (1.0 - removed.gradient[0]);
    return NearestPoint::Side{
        std::hypot(pinion.base_radius, touch.rho),    touch.z, std::hypot(wheel.base_radius, touch.wheel_rho), touch.wheel_z, scale * by_pinion,
        scale * touch.wheel_pace / wheel.base_radius, share};
  };
  NearestPoint nearest;
  nearest.sides[0] = side(touch_at(found.at), 1.0 - found.share_beyond);
  if (found.share_beyond != 0.0) nearest.sides[1] = side(found.beyond, found.share_beyond);
  nearest.pinion_radius = nearest.sides[0].pinion_radius;
  nearest.wheel_radius = found.at.wheel_radius;
  return nearest;
}

Gap SurfaceGap::at(const std::vector<ContactPoint>& points, double line_phase) const {
  const std::vector<SectionMaximum> found = maxima(points, line_phase);
  const double phi1 = PathOfContact(pair_).pinion_angle_at(line_phase, pair_);
  const double scale = assembly_.wheel.base_radius * std::cos(pair_.base_helix_angle);
  const Eigen::Index n = static_cast<Eigen::Index>(points.size());
  Gap gap{Eigen::VectorXd(n), Eigen::VectorXd(n), FlankTouchSearch(pair_, condition_, condition_.misalignment).at(points)};
  gap.nearest.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    gap.total[k] = scale * (assembly_.speed_ratio() * phi1 - found[i].phi2) - gap.touches[i].rounded_off;
    gap.error[k] = points[i].clearance - gap.total[k];
    gap.nearest.push_back(nearest_point(found[i], points[i].tooth));
  }
  return gap;
}

Eigen::VectorXd SurfaceGap::derivative(const std::vector<ContactPoint>& points, const Gap& gap, Member member,
                                       ModificationParameter parameter) const {
  const Flank& flank = assembly_[member];
  const bool of_parabola = parameter == parameter_of("parabolic_te");  // a field of the roll length, see Flank
  const auto& parabola = parabola_[static_cast<std::size_t>(member)];
  const GroundDerivative removed = ground_derivative(pair_, member, condition_.modification[member], parameter, condition_.other_flanks);
  const bool of_roll = of_parabola || removed.is_shifted();
  const auto by_parameter = [&](double radius, double z) {
    const double roll = flank.roll_at(radius);
    if (of_parabola && parabola) return parabola->coefficient_slope(roll, z);
    return removed.at(of_roll ? std::hypot(flank.frame.base_radius, roll) : radius, z);
  };
  Eigen::VectorXd derivative = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(gap.nearest.size()));
  const TouchDerivative touches(pair_, condition_, member, parameter);
  for (std::size_t i = 0; i < gap.nearest.size(); ++i) {
    derivative[static_cast<Eigen::Index>(i)] = touches.of_rounding(points[i], gap.touches[i]);
    for (const NearestPoint::Side& side : gap.nearest[i].sides) {
      if (side.share == 0.0) continue;
      derivative[static_cast<Eigen::Index>(i)] +=
          side.share * (member == Member::Pinion ? side.by_pinion * by_parameter(side.pinion_radius, side.pinion_z)
                                                 : side.by_wheel * by_parameter(side.wheel_radius, side.wheel_z));
    }
  }
  return derivative;
}

std::vector<ContactPoint> SurfaceGap::place(const std::vector<ContactPoint>& points, double line_phase) const {
  const std::vector<SectionMaximum> found = maxima(points, line_phase);
  const Gap aligned = SurfaceGap(pair_, {}).at(points, line_phase);
  FlankCondition unmodified;
  unmodified.misalignment = condition_.misalignment;
  const std::vector<FlankTouch> displaced = FlankTouchSearch(pair_, unmodified).at(points);
  const auto passed = [](const TipEdge& edge, double radius) { return PassedEdge::at(std::min(0.0, edge.distance), radius, edge.radius); };
  std::vector<ContactPoint> placed;
  placed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!found[i].exists) continue;
    const NearestPoint nearest = nearest_point(found[i], points[i].tooth);
    ContactPoint point = points[i];
    if (point.clearance > 0.0) point.clearance = aligned.total[static_cast<Eigen::Index>(i)];
    set_rolls(pair_, pair_.pinion.roll_length_at(nearest.pinion_radius), pair_.wheel.roll_length_at(nearest.wheel_radius), point);
    point.tip_edge = points[i].tip_edge;
    if (const double moved = edge_moved_by(points[i], displaced[i]); moved != 0.0 && point.tip_edge.radius >= 0.0) {
      TipEdge& edge = point.tip_edge;
      const double R = points[i].relative_radius;
      const double before = passed(edge, R).rounded;
      edge.distance += moved;
      const PassedEdge after = passed(edge, R);
      edge.rounded_off = after.rounded_off;
      point.clearance = std::max(0.0, point.clearance - before + after.rounded);
    }
    placed.push_back(point);
  }
  return placed;
}

}  // namespace flankwright
