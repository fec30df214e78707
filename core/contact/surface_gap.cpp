#include "core/contact/surface_gap.hpp"

#include <cmath>
#include <optional>

namespace flankwright {

namespace {

/// How a point of the pinion's flank moves with its lead-angle (0) or pressure-angle (1) error, rho and z held [mm/rad]:
///
///     point = r_b e + along t,   theta = origin + rate z - rho/r_b,   along = rho - D(sqrt(r_b^2 + rho^2), z)
Eigen::Vector3d motion_by_error(const Flank& pinion, const PinionHelicoid& helicoid, int error, const Meeting& m,
                                const Eigen::Vector3d& point, int tooth) {
  const double rb = pinion.base_radius, d_rb = helicoid.base_radius.gradient[error];
  // Only the part of D that is a function of the radius changes with r_b.
  Dual<1> removed = pinion.deviation(Dual<1>::variable(m.rho, 0), Dual<1>(m.z), tooth);
  for (const auto& field : pinion.fields) removed.gradient[0] -= field->at(m.rho, m.z).u;
  if (const DeviationField* measured = tooth_topography(pinion.error, tooth)) removed.gradient[0] -= measured->at(m.rho, m.z).u;
  const Eigen::Vector3d radial(point.x(), point.y(), 0.0), turned(-point.y(), point.x(), 0.0);  // turned = r_b t - along e
  const double square = radial.squaredNorm(), along = std::sqrt(std::max(0.0, square - rb * rb));
  const Eigen::Vector3d e = (rb * radial - along * turned) / square, t = (along * radial + rb * turned) / square;
  return (1.0 - along * m.rho / (rb * rb)) * d_rb * e + (m.rho / rb - removed.gradient[0] * rb / m.rho) * d_rb * t +
         (helicoid.origin.gradient[error] + m.z * helicoid.helix_rate.gradient[error]) * turned;
}

}  // namespace

SurfaceGap::SurfaceGap(const GearPair& pair, const FlankCondition& condition)
    : pair_(pair),
      condition_(condition),
      scene_(make_mesh_scene(pair, condition.misalignment, condition.pinion_modification, condition.wheel_modification,
                             condition.pinion_error, condition.wheel_error)),
      density_(search_density(scene_)) {
  for (Member m : {Member::Pinion, Member::Wheel}) {
    const double coefficient = condition.modification(m).parabolic_te;
    if (coefficient != 0.0) parabola_[static_cast<std::size_t>(m)] = make_conjugate_field(pair, m, coefficient);
  }
}

std::vector<SectionMaximum> SurfaceGap::maxima(const std::vector<ContactPoint>& points, double line_phase) const {
  const double phi1 = PathOfContact(pair_).pinion_angle_at(line_phase, pair_);
  std::vector<SectionMaximum> found;
  found.reserve(points.size());
  std::optional<FlankMeeting> meeting;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool same_tooth = i > 0 && points[i].tooth == points[i - 1].tooth;
    if (!same_tooth) meeting.emplace(scene_, points[i].tooth, phi1);
    const SectionSearch search(*meeting, density_.cells);
    SectionMaximum best = search.at(points[i].z, same_tooth ? found.back() : SectionMaximum{}, SectionAccuracy::Full);
    if (!best.exists) {
      best.at = meeting->at(scene_.pinion.roll_at(points[i].pinion_radius), points[i].z);
      best.phi2 = meeting->phi2(best.at);
      best.slope_phi1 = best.at.angle.phi1;
    }
    found.push_back(best);
  }
  return found;
}

/// What is removed from the pinion moves its point as a turn backwards by D/r_b1 and, with the slope of D, a step along the
/// profile do: per unit of D, 1/(1 - D') of either. What is removed from the wheel lets it turn on by D/r_b2 times its pace.
NearestPlace SurfaceGap::nearest_place(const SectionMaximum& found, int tooth) const {
  const Flank &pinion = scene_.pinion, &wheel = scene_.wheel;
  const double scale = wheel.base_radius * std::cos(pair_.base_helix_angle);
  const bool on_wheel_circle = found.bound == SectionBound::WheelTip || found.bound == SectionBound::WheelRoot;
  const auto side = [&](const Touch& touch, double share) {
    // On a circle of the wheel the point slides along it: that is in the slope of the path already.
    const double turning = on_wheel_circle ? found.slope_phi1 : touch.slope_phi1;
    const double stepping = on_wheel_circle ? 0.0 : touch.slope_rho;
    const Dual<1> removed = pinion.deviation(Dual<1>::variable(touch.rho, 0), Dual<1>(touch.z), tooth);
    const double by_pinion = (turning / pinion.base_radius + stepping) / (1.0 - removed.gradient[0]);
    return NearestPlace::Side{std::hypot(pinion.base_radius, touch.rho),     touch.z,
                              std::hypot(wheel.base_radius, touch.wheel_rho), touch.wheel_z,
                              scale * by_pinion,                              scale * touch.wheel_pace / wheel.base_radius, share};
  };
  NearestPlace place;
  place.bound = found.bound;
  place.sides[0] = side(touch_at(found.at), 1.0 - found.share_beyond);
  if (found.share_beyond != 0.0) place.sides[1] = side(found.beyond, found.share_beyond);
  place.pinion_radius = place.sides[0].pinion_radius;
  place.wheel_radius = found.at.wheel_radius;
  return place;
}

Gap SurfaceGap::at(const std::vector<ContactPoint>& points, double line_phase) const {
  const std::vector<SectionMaximum> found = maxima(points, line_phase);
  const double phi1 = PathOfContact(pair_).pinion_angle_at(line_phase, pair_);
  const double scale = scene_.wheel.base_radius * std::cos(pair_.base_helix_angle);
  const Eigen::Index n = static_cast<Eigen::Index>(points.size());
  Gap gap{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  gap.nearest.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    gap.total[k] = scale * (scene_.speed_ratio() * phi1 - found[i].phi2);
    gap.error[k] = points[i].clearance - gap.total[k];
    gap.nearest.push_back(nearest_place(found[i], points[i].tooth));
  }
  return gap;
}

Eigen::VectorXd SurfaceGap::derivative(const Gap& gap, Member member, ModificationParameter parameter) const {
  const Flank& flank = member == Member::Pinion ? scene_.pinion : scene_.wheel;
  const bool of_parabola = parameter == ModificationParameter::ParabolicTe;  // a field of the roll length, see Flank
  const auto& parabola = parabola_[static_cast<std::size_t>(member)];
  const auto by_parameter = [&](double radius, double z) {
    const double roll = flank.roll_at(radius);
    if (of_parabola && parabola) return parabola->coefficient_slope(roll, z);
    return removal_derivative(condition_.modification(member), flank.frame, parameter,
                              of_parabola ? std::hypot(flank.frame.base_radius, roll) : radius, z);
  };
  Eigen::VectorXd derivative = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(gap.nearest.size()));
  for (std::size_t i = 0; i < gap.nearest.size(); ++i) {
    for (const NearestPlace::Side& side : gap.nearest[i].sides) {
      if (side.share == 0.0) continue;
      derivative[static_cast<Eigen::Index>(i)] +=
          side.share * (member == Member::Pinion ? side.by_pinion * by_parameter(side.pinion_radius, side.pinion_z)
                                                 : side.by_wheel * by_parameter(side.wheel_radius, side.wheel_z));
    }
  }
  return derivative;
}

/// d(phi2)/dp of the place held on what bounds it: how the point moves relative to the wheel, and how far it slides for that.
double SurfaceGap::angle_derivative(const FlankMeeting& meeting, const NearestPlace& place, const NearestPlace::Side& side,
                                    const ContactPoint& section, double Misalignment::* parameter) const {
  const Flank& pinion = scene_.pinion;
  const double rho = pinion.roll_at(side.pinion_radius);
  const Meeting m = meeting.at(rho, section.z);
  const Eigen::Vector3d arm = scene_.wheel_axes * m.place;  // from the wheel's centre, housing
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  double bound_moves = 0.0;  // of the pinion's roll length at tip or root
  if (parameter == &Misalignment::crossing || parameter == &Misalignment::intersecting) {
    motion = -tilt_rate(pair_, condition_.misalignment, parameter).cross(arm);
  } else if (parameter == &Misalignment::centre_distance) {
    motion = -Eigen::Vector3d::UnitX();
  } else if (parameter == &Misalignment::axial_offset) {
    motion = -Eigen::Vector3d::UnitZ();
  } else {
    const PinionHelicoid helicoid = pinion_helicoid(pair_, condition_.misalignment);
    const int error = parameter == &Misalignment::pinion_lead_angle ? 0 : 1;
    const double rb = pinion.base_radius, d_rb = helicoid.base_radius.gradient[error];
    motion = motion_by_error(pinion, helicoid, error, m, arm + scene_.wheel_centre, section.tooth);
    const bool at_lowest_start = place.bound == SectionBound::PinionRoot && pinion.form_radius == rb * lowest_start;
    if (place.bound == SectionBound::PinionTip || place.bound == SectionBound::PinionRoot) {
      bound_moves = at_lowest_start ? rho / rb * d_rb : -rb / rho * d_rb;
    }
  }
  if (m.on_wheel_end) {
    const Eigen::Vector3d axis = scene_.wheel_axes.col(2);
    motion -= m.along_z * (axis.dot(motion) / axis.dot(m.along_z));
  }
  double derivative = m.turn.dot(motion) + m.angle.rho * bound_moves;
  if (place.bound == SectionBound::WheelTip || place.bound == SectionBound::WheelRoot) {
    const Eigen::Vector3d outwards = scene_.wheel_axes * Eigen::Vector3d(m.place.x(), m.place.y(), 0.0) / m.wheel_radius;
    derivative -= m.angle.rho / meeting.radius_gradient(m).rho * outwards.dot(motion);
  }
  return derivative;
}

Eigen::VectorXd SurfaceGap::derivative(const std::vector<ContactPoint>& points, double line_phase, const Gap& gap,
                                       double Misalignment::* parameter) const {
  const double phi1 = PathOfContact(pair_).pinion_angle_at(line_phase, pair_);
  const double scale = scene_.wheel.base_radius * std::cos(pair_.base_helix_angle);
  Eigen::VectorXd derivative = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const NearestPlace& place = gap.nearest[i];
    const FlankMeeting meeting(scene_, points[i].tooth, phi1);
    for (const NearestPlace::Side& side : place.sides) {
      if (side.share == 0.0) continue;
      // F_beta_y is removed from the wheel as z/b of its own.
      derivative[static_cast<Eigen::Index>(i)] +=
          side.share * (parameter == &Misalignment::mesh_misalignment
                            ? side.by_wheel * side.wheel_z / pair_.face_width
                            : -scale * angle_derivative(meeting, place, side, points[i], parameter));
    }
  }
  return derivative;
}

std::vector<ContactPoint> SurfaceGap::place(const std::vector<ContactPoint>& points, double line_phase) const {
  const std::vector<SectionMaximum> found = maxima(points, line_phase);
  const Gap aligned = SurfaceGap(pair_, {}).at(points, line_phase);
  std::vector<ContactPoint> placed;
  placed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!found[i].exists) continue;
    const NearestPlace place = nearest_place(found[i], points[i].tooth);
    ContactPoint point = points[i];
    if (point.clearance > 0.0) point.clearance = aligned.total[static_cast<Eigen::Index>(i)];
    set_rolls(pair_, pair_.pinion.roll_length_at(place.pinion_radius), pair_.wheel.roll_length_at(place.wheel_radius), point);
    placed.push_back(point);
  }
  return placed;
}

}  // namespace flankwright
