#include "core/compliance/shaft/shaft_pair.hpp"

#include <algorithm>
#include <cmath>

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

std::vector<BeamSupport> supports(const ShaftData& shaft) {
  using Eigen::Vector3d;
  std::vector<BeamSupport> result;
  const auto hold = [&](double z, const Vector3d& force, const Vector3d& moment, double stiffness) {
    if (stiffness > 0.0) result.push_back({{z, force, moment}, 1.0 / stiffness});  // 1/infinity: rigid
  };
  for (const ShaftBearing& bearing : shaft.bearings) {
    for (const Vector3d& across : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY())}) {
      hold(bearing.position, across, Vector3d::Zero(), bearing.radial_stiffness);
      hold(bearing.position, Vector3d::Zero(), across, bearing.tilting_stiffness);
    }
    hold(bearing.position, Vector3d::UnitZ(), Vector3d::Zero(), bearing.axial_stiffness);
  }
  hold(shaft.torque_position, Vector3d::Zero(), Vector3d::UnitZ(), std::numeric_limits<double>::infinity());
  return result;
}

}  // namespace

std::vector<BeamPiece> shaft_pieces(const ShaftData& shaft, const Gear& gear) {
  const std::vector<InvalidInput> problems = find_problems(shaft, gear.data.face_width);
  if (!problems.empty()) throw problems.front();
  const double first = shaft.gear_position - 0.5 * gear.data.face_width, last = first + gear.data.face_width;
  std::vector<BeamPiece> pieces;
  double from = 0.0;
  for (const ShaftSection& section : shaft.sections) {
    const double to = from + section.length;
    const double cuts[] = {from, std::clamp(first, from, to), std::clamp(last, from, to), to};
    for (int i = 0; i < 3; ++i) {
      const double length = cuts[i + 1] - cuts[i];
      if (!(length > 0.0)) continue;
      const bool in_gear = i == 1 && shaft.gear_stiffens;
      const double root = 2.0 * gear.root_radius, mean = gear.root_radius + gear.tip_radius, own = section.outer_diameter;
      pieces.push_back(
          piece(shaft.material, length, in_gear ? std::max(own, root) : own, in_gear ? std::max(own, mean) : own, section.inner_diameter));
    }
    from = to;
  }
  return pieces;
}

ShaftBeam make_shaft_beam(const ShaftData& shaft, const Gear& gear) { return {shaft_pieces(shaft, gear), supports(shaft)}; }

ShaftPair::ShaftPair(const GearPair& pair, std::optional<ShaftData> pinion, std::optional<ShaftData> wheel, PerGear<GearBodyIn> body)
    : pair_(pair), path_(pair), body_(body) {
  const auto seat = [&](Member member, std::optional<ShaftData>& data, std::optional<Side>& side) {
    if (!data) return;
    const std::vector<InvalidInput> problems = find_problems(*data, pair[member].data.face_width);
    if (!problems.empty()) {
      const char* table = member == Member::Pinion ? "pinion.shaft." : "wheel.shaft.";
      throw InvalidInput(table + problems.front().field(), problems.front().value(), problems.front().allowed());
    }
    side.emplace(Side{*data, make_shaft_beam(*data, pair[member])});
  };
  seat(Member::Pinion, pinion, pinion_);
  seat(Member::Wheel, wheel, wheel_);
}

std::vector<BeamLoad> ShaftPair::loads(Member member, const std::vector<ContactPoint>& points, double axial_offset) const {
  using Eigen::Vector3d;
  const bool is_pinion = member == Member::Pinion;
  const ShaftData& shaft = side(member)->data;
  const double alpha = pair_.working_transverse_pressure_angle, beta = pair_.base_helix_angle;
  // The pinion's outward normal, seen in W; the wheel is pushed along it, the pinion against it.
  const Vector3d normal(std::cos(beta) * std::sin(alpha), std::cos(beta) * std::cos(alpha), -pair_.contact_line_sense() * std::sin(beta));
  const Vector3d force = is_pinion ? Vector3d(-normal) : normal;
  std::vector<BeamLoad> result;
  result.reserve(points.size() * static_cast<std::size_t>(parts(member)));
  for (const ContactPoint& point : points) {
    const double s = path_.roll_at(point.phase) - pair_.pitch_point;  // from the pitch point along the line of action
    const double to_axis = is_pinion ? pair_.pinion.working_pitch_radius : -pair_.wheel.working_pitch_radius;
    const Vector3d arm(to_axis + s * std::sin(alpha), s * std::cos(alpha), 0.0);
    const Vector3d moment = arm.cross(force);
    const double z = shaft.gear_position + point.z - (is_pinion ? 0.0 : axial_offset);
    if (body_[member] == GearBodyIn::Shaft) {
      result.push_back({z, force, moment});
      continue;
    }
    if (body_[member] == GearBodyIn::RigidBore) {
      const Vector3d from_mid_face(0.0, 0.0, z - shaft.gear_position);
      result.push_back({shaft.gear_position, force, moment + from_mid_face.cross(force)});
      continue;
    }
    const double end = shaft.gear_position + 0.5 * shaft.torque_side() * pair_[member].data.face_width;
    result.push_back({z, force, Vector3d::Zero()});
    result.push_back({shaft.gear_position, Vector3d::Zero(), {moment.x(), moment.y(), 0.0}});
    result.push_back({end, Vector3d::Zero(), {0.0, 0.0, moment.z()}});
  }
  return result;
}

Eigen::MatrixXd ShaftPair::influence(const std::vector<ContactPoint>& points, double axial_offset) const {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  for (Member member : {Member::Pinion, Member::Wheel}) {
    if (has_shaft(member)) sum += side(member)->beam.flexibility(loads(member, points, axial_offset), parts(member));
  }
  return sum;
}

ShaftMotion ShaftPair::motion(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset) const {
  ShaftMotion result;
  if (!has_shaft(member)) return result;
  // Where the line through the pitch point lies at mid face and at the ends of the common face.
  std::vector<ContactPoint> stations(3);
  const double first = std::max(-0.5 * pair_.pinion.data.face_width, axial_offset - 0.5 * pair_.wheel.data.face_width);
  const double last = std::min(0.5 * pair_.pinion.data.face_width, axial_offset + 0.5 * pair_.wheel.data.face_width);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    stations[i].z = first + 0.5 * static_cast<double>(i) * (last - first);
    stations[i].phase = (pair_.pitch_point - path_.roll_at_start) / path_.base_pitch;
  }
  const Eigen::VectorXd moved =
      side(member)->beam.flexibility(loads(member, stations, axial_offset), loads(member, points, axial_offset), parts(member)) * forces /
      std::cos(pair_.base_helix_angle);
  result.displacement = moved[1];
  result.misalignment = moved[2] - moved[0];
  return result;
}

}  // namespace flankwright
