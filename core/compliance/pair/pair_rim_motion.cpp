#include "core/compliance/pair/pair_rim_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/compliance/pair/pair_compliance.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright {
namespace {

using Motion = Eigen::Vector<double, 6>;  ///< (t, omega)

/// The motion turned about the gear's axis, counter-clockwise.
Motion turned(const Motion& motion, double angle) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  Motion result;
  result << turn * motion.head<3>(), turn * motion.tail<3>();
  return result;
}

/// Motion along the outward transverse normal at the angle `normal` from +x, by length along z.
double slope(const Motion& motion, double normal) { return motion[4] * std::cos(normal) - motion[3] * std::sin(normal); }

}  // namespace

PairRimMotion::PairRimMotion(const GearPair& pair, PerGear<Rim> rims) : pair_(pair), rims_(std::move(rims)) {
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const Gear& gear = pair[member];
    GearData data = gear.data;
    data.tip_diameter = 2 * gear.tip_radius;
    const ToothForm form(data, pair.data.normal_module, pair.data.pressure_angle, pair.data.helix_angle);
    const double alpha = std::acos(form.base_radius() / form.tip_radius());
    base_half_angle_[member] = form.tip_half_angle() + std::tan(alpha) - alpha;
  }
}

RimMotion PairRimMotion::motion(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset) const {
  RimMotion result;
  if (!has_rim(member)) return result;
  const RimMotionTable& table = *rims_[member].table;
  const Gear& gear = pair_[member];
  const double module = pair_.data.normal_module, unit = rims_[member].youngs_modulus * module;
  const double pitch = 2 * units::pi / gear.data.teeth, twist = std::tan(pair_.data.helix_angle) / gear.reference_radius;
  const double to_pair = -pair_.acute_end(member);  // z of the pair over z of GearToMesh
  Motion scale;
  scale << Eigen::Vector3d::Constant(1 / unit), Eigen::Vector3d::Constant(1 / (unit * module));

  // Forces at the stations of the table, by tooth, and the direction of the common normal beside tooth 0: that of the involute, roll angle less
  // half the tooth, turned by the tooth's number and the helix. It is the same at all points of the plane of action.
  std::map<int, Eigen::VectorXd> loads;
  std::map<int, double> of_tooth;  // force
  double total = 0, normal = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double force = forces[static_cast<Eigen::Index>(i)];
    if (force == 0) continue;
    const FlankStation station = flank_station(pair_, member, points[i], axial_offset);
    loads.try_emplace(station.tooth, Eigen::VectorXd::Zero(table.grid.size())).first->second += force * table.grid.weights(station);
    of_tooth[station.tooth] += force;
    const double radius = gear.form_radius + (station.u + 1) / 2 * (gear.tip_radius - gear.form_radius);
    const double roll = std::sqrt(std::max(0.0, std::pow(radius / gear.base_radius, 2) - 1));
    const double z = station.zeta * module - gear.data.face_width / 2;
    normal += force * (roll - base_half_angle_[member] + twist * z + station.tooth * pitch);
    total += force;
  }
  if (!(total > 0)) {
    result.radial = result.axial = result.tilt = result.misalignment = result.misalignment_at_teeth = 0;
    return result;
  }
  normal /= total;

  const double first = std::max(-0.5 * pair_.pinion.data.face_width, axial_offset - 0.5 * pair_.wheel.data.face_width);
  const double last = std::min(0.5 * pair_.pinion.data.face_width, axial_offset + 0.5 * pair_.wheel.data.face_width);
  const auto opens = [&](const Motion& motion, double along) { return -to_pair * (last - first) * slope(motion, along); };

  Motion whole = Motion::Zero();
  double at_teeth = 0;
  for (const auto& [tooth, load] : loads) {
    whole += turned(scale.asDiagonal() * (table.whole * load), tooth * pitch);
    Motion below = Motion::Zero();
    for (const auto& [loaded, other] : loads) {
      const int apart = loaded - tooth;
      if (std::abs(apart) > table.teeth_each_side()) continue;
      below += scale.asDiagonal() * (table.below[static_cast<std::size_t>(apart + table.teeth_each_side())] * other);
    }
    at_teeth += of_tooth.at(tooth) / total * opens(below, normal - tooth * pitch);
  }
  const double centres = normal - pair_.working_transverse_pressure_angle + units::pi / 2;  // towards the mate
  result.radial = -(whole[0] * std::cos(centres) + whole[1] * std::sin(centres));
  result.axial = to_pair * whole[2];
  result.tilt = std::hypot(whole[3], whole[4]);
  result.misalignment = opens(whole, normal);
  result.misalignment_at_teeth = at_teeth;
  return result;
}

}  // namespace flankwright
