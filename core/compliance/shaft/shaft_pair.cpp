#include "core/compliance/shaft/shaft_pair.hpp"
#include "core/compliance/shaft/unit_checks.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace flankwright {

namespace {

double area(double outer, double inner) { return units::pi * (outer - inner) * (outer + inner) / 4.0; }
double second_moment(double outer, double inner) { return units::pi * (std::pow(outer, 4) - std::pow(inner, 4)) / 64.0; }

/// Cowper's, of a hollow circle.
double shear_coefficient(double ratio, double nu) {
  const double m2 = ratio * ratio, round = (1.0 + m2) * (1.0 + m2);
  return 6.0 * (1.0 + nu) * round / ((7.0 + 6.0 * nu) * round + (20.0 + 12.0 * nu) * m2);
}

BeamPiece piece(const Material& material, double length, double shear_diameter, double bending_diameter, double inner) {
  const double E = material.youngs_modulus, nu = material.poissons_ratio, G = E / (2.0 * (1.0 + nu));
  const double A = area(shear_diameter, inner);
  return {length, 1.0 / (E * second_moment(bending_diameter, inner)), 1.0 / (shear_coefficient(inner / shear_diameter, nu) * G * A),
          1.0 / (G * 2.0 * second_moment(shear_diameter, inner)), 1.0 / (E * A)};
}

}  // namespace

std::vector<BeamPiece> shaft_pieces(const ShaftData& shaft, const std::vector<GearSeat>& seats) {
  std::vector<BeamPiece> pieces;
  double from = 0.0;
  for (const ShaftSection& section : shaft.sections) {
    const double to = from + section.length;
    std::vector<double> cuts{from, to};
    for (const GearSeat& seat : seats) {
      for (const double cut : {seat.from, seat.to}) cuts.push_back(std::clamp(cut, from, to));
    }
    std::ranges::sort(cuts);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double length = cuts[i + 1] - cuts[i], middle = 0.5 * (cuts[i] + cuts[i + 1]);
      if (!(length > 0.0)) continue;
      double shear = section.outer_diameter, bending = section.outer_diameter;
      for (const GearSeat& seat : seats) {
        if (!(seat.from < middle && middle < seat.to)) continue;
        shear = std::max(shear, 2.0 * seat.root_radius);
        bending = std::max(bending, seat.root_radius + seat.tip_radius);
      }
      pieces.push_back(piece(shaft.material, length, shear, bending, section.inner_diameter));
    }
    from = to;
  }
  return pieces;
}

namespace {

/// The gears that are one with a shaft: the pair's, and those of other meshes with a root and tip of the basic rack.
std::vector<GearSeat> seats_on(const ShaftsOfPair& shafts, int index, const GearPair& pair) {
  std::vector<GearSeat> seats;
  const std::string name = shafts.names()[static_cast<std::size_t>(index)];
  const ShaftData& shaft = *shafts.all()[static_cast<std::size_t>(index)];
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (name != name_of(m) || !shaft.gear_stiffens) continue;
    const Gear& gear = pair[m];
    const double first = shaft.gear_position - 0.5 * gear.data.face_width;
    seats.push_back({first, first + gear.data.face_width, gear.root_radius, gear.tip_radius});
  }
  constexpr double addendum = 1.0, dedendum = 1.25;  // of the basic rack [ISO 53], in normal modules
  for (const UnitMesh& mesh : shafts.unit.meshes) {
    for (std::size_t g = 0; g < 2; ++g) {
      const UnitGear& gear = mesh.gears[g];
      if (gear.shaft != name || !(gear.face_width > 0.0)) continue;
      const double radius = geometry_of(mesh).reference_radius[g], first = gear.position - 0.5 * gear.face_width;
      seats.push_back({first, first + gear.face_width, radius - dedendum * mesh.normal_module, radius + addendum * mesh.normal_module});
    }
  }
  return seats;
}

}  // namespace

ShaftPair::ShaftPair(const GearPair& pair, ShaftsOfPair shafts, PerGear<GearBodyIn> body) : pair_(pair), path_(pair), body_(body) {
  const std::vector<InvalidInput> problems = find_problems(shafts, pair);
  if (!problems.empty()) throw problems.front();
  shafts_ = std::move(shafts);
  settle_turning_holds(shafts_, pair);
  given_ = shafts_;
  if (pair.data.working_flank == WorkingFlank::Left) shafts_ = mirrored(std::move(shafts_));
  for (const Member m : {Member::Pinion, Member::Wheel}) index_[m] = shafts_.find(m).value_or(-1);
  if (!shafts_.any()) return;
  for (std::size_t i = 0; i < shafts_.all().size(); ++i) {
    pieces_.push_back(shaft_pieces(*shafts_.all()[i], seats_on(shafts_, static_cast<int>(i), pair)));
  }
  if (!shafts_.unit.empty()) {
    torques_ = torque_balance(shafts_, pair);
    outside_ = outside_loads(shafts_, torques_);
    constant_ = constant_loads(shafts_);
  }
  supports_ = make_supports(shafts_, torques_);
  system_.emplace(pieces_, supports_.supports, supports_.further);
  for (std::size_t i = 0; i < supports_.bearings.size(); ++i) {
    const ShaftBearing& bearing = supports_.bearings[i].data;
    if (!bearing.depends_on_load()) continue;
    nonlinear_.push_back(static_cast<int>(i));
    nonlinear_bearings_.push_back({0.5 * bearing.radial_clearance, bearing.law.given() ? std::optional<RadialLaw>(bearing.law) : std::nullopt});
  }
}

void ShaftPair::add_loads(Member member, const ContactPoint& point, double axial_offset, std::vector<BeamLoad>& result) const {
  using Eigen::Vector3d;
  if (!has_shaft(member)) return;
  const bool is_pinion = member == Member::Pinion;
  const ShaftData& shaft = *shafts_.shaft[member];
  const int beam = index_[member];
  const double alpha = pair_.working_transverse_pressure_angle, beta = pair_.base_helix_angle;
  // The pinion's outward normal, seen in W; the wheel is pushed along it, the pinion against it.
  const Vector3d normal(std::cos(beta) * std::sin(alpha), std::cos(beta) * std::cos(alpha), -pair_.contact_line_sense() * std::sin(beta));
  const Vector3d force = is_pinion ? Vector3d(-normal) : normal;
  const double s = path_.roll_at(point.phase) - pair_.pitch_point;  // from the pitch point along the line of action
  const double to_axis = is_pinion ? pair_.pinion.working_pitch_radius : -pair_.wheel.working_pitch_radius;
  const Vector3d arm(to_axis + s * std::sin(alpha), s * std::cos(alpha), 0.0);
  const Vector3d moment = arm.cross(force);
  const double z = shaft.gear_position + point.z - (is_pinion ? 0.0 : axial_offset);
  if (body_[member] == GearBodyIn::Shaft) {
    result.push_back({z, force, moment, beam});
    return;
  }
  if (body_[member] == GearBodyIn::RigidBore) {
    const Vector3d from_mid_face(0.0, 0.0, z - shaft.gear_position);
    result.push_back({shaft.gear_position, force, moment + from_mid_face.cross(force), beam});
    return;
  }
  const double end = shaft.gear_position + 0.5 * shaft.torque_side() * pair_[member].data.face_width;
  result.push_back({z, force, Vector3d::Zero(), beam});
  result.push_back({shaft.gear_position, Vector3d::Zero(), {moment.x(), moment.y(), 0.0}, beam});
  result.push_back({end, Vector3d::Zero(), {0.0, 0.0, moment.z()}, beam});
}

std::vector<BeamLoad> ShaftPair::loads(const std::vector<ContactPoint>& points, double axial_offset) const {
  std::vector<BeamLoad> result;
  result.reserve(points.size() * static_cast<std::size_t>(parts()));
  for (const ContactPoint& point : points) {
    for (const Member m : {Member::Pinion, Member::Wheel}) add_loads(m, point, axial_offset, result);
  }
  return result;
}

std::vector<BeamLoad> ShaftPair::loads(Member member, const std::vector<ContactPoint>& points, double axial_offset) const {
  std::vector<BeamLoad> result;
  for (const ContactPoint& point : points) add_loads(member, point, axial_offset, result);
  return result;
}

Eigen::MatrixXd ShaftPair::influence(const std::vector<ContactPoint>& points, double axial_offset) const {
  const auto n = static_cast<Eigen::Index>(points.size());
  if (parts() == 0 || n == 0) return Eigen::MatrixXd::Zero(n, n);
  return system_->flexibility(loads(points, axial_offset), parts());
}

OutsideMotion ShaftPair::outside_motion(const std::vector<ContactPoint>& points, double axial_offset) const {
  OutsideMotion motion;
  if (parts() == 0 || points.empty()) return motion;
  const std::vector<BeamLoad> here = loads(points, axial_offset);
  if (!outside_.empty()) {
    motion.by_force = system_->flexibility(here, outside_, parts(), static_cast<int>(outside_.size())).col(0) / force_per_torque();
  }
  motion.fixed = fixed_motion(here, parts());
  return motion;
}

Eigen::VectorXd ShaftPair::fixed_motion(const std::vector<BeamLoad>& rows, int parts) const {
  Eigen::VectorXd motion;
  if (prestrain_.size() > 0) motion = -system_->reactions(rows, parts).transpose() * prestrain_;
  if (constant_.empty()) return motion;
  const Eigen::VectorXd by_loads = system_->flexibility(rows, constant_, parts, static_cast<int>(constant_.size())).col(0);
  if (motion.size() == 0) return by_loads;
  return motion + by_loads;
}

double ShaftPair::common_face_middle(double axial_offset) const {
  const double first = std::max(-0.5 * pair_.pinion.data.face_width, axial_offset - 0.5 * pair_.wheel.data.face_width);
  const double last = std::min(0.5 * pair_.pinion.data.face_width, axial_offset + 0.5 * pair_.wheel.data.face_width);
  return 0.5 * (first + last);
}

ContactPoint ShaftPair::pitch_point(double axial_offset) const {
  ContactPoint point;
  point.z = common_face_middle(axial_offset);
  point.phase = (pair_.pitch_point - path_.roll_at_start) / path_.base_pitch;
  return point;
}

ShaftMotion ShaftPair::moved(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset,
                             double fixed) const {
  ShaftMotion result;
  if (!has_shaft(member)) return result;
  // Where the line through the pitch point lies at mid face and at the ends of the common face.
  std::vector<ContactPoint> stations(3, pitch_point(axial_offset));
  const double first = std::max(-0.5 * pair_.pinion.data.face_width, axial_offset - 0.5 * pair_.wheel.data.face_width);
  const double last = std::min(0.5 * pair_.pinion.data.face_width, axial_offset + 0.5 * pair_.wheel.data.face_width);
  for (std::size_t i = 0; i < stations.size(); ++i) stations[i].z = first + 0.5 * static_cast<double>(i) * (last - first);
  const std::vector<BeamLoad> here = loads(member, stations, axial_offset);
  // K is symmetric: three columns are solved for, and not one for every point.
  Eigen::VectorXd motion = system_->flexibility(loads(points, axial_offset), here, parts(), parts(member)).transpose() * forces;
  if (!outside_.empty()) {
    motion += forces.sum() / force_per_torque() * system_->flexibility(here, outside_, parts(member), static_cast<int>(outside_.size())).col(0);
  }
  if (const Eigen::VectorXd always = fixed_motion(here, parts(member)); always.size() > 0) motion += fixed * always;
  motion /= std::cos(pair_.base_helix_angle);
  result.displacement = motion[1];
  result.misalignment = motion[2] - motion[0];
  return result;
}

ShaftMotion ShaftPair::motion(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset) const {
  return moved(member, points, forces, axial_offset, 1.0);
}

ShaftMotion ShaftPair::motion_by(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset) const {
  return moved(member, points, forces, axial_offset, 0.0);
}

}  // namespace flankwright
