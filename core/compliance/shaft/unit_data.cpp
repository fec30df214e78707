#include "core/compliance/shaft/unit_data.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

namespace flankwright {

std::vector<const ShaftData*> ShaftsOfPair::all() const {
  std::vector<const ShaftData*> found;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (shaft[m]) found.push_back(&*shaft[m]);
  }
  for (const ShaftData& further : unit.shafts) found.push_back(&further);
  return found;
}

std::vector<std::string> ShaftsOfPair::names() const {
  std::vector<std::string> found;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (shaft[m]) found.emplace_back(name_of(m));
  }
  for (const ShaftData& further : unit.shafts) found.push_back(further.name);
  return found;
}

std::optional<int> ShaftsOfPair::find(const std::string& name) const {
  const std::vector<std::string> known = names();
  const auto found = std::ranges::find(known, name);
  return found == known.end() ? std::nullopt : std::optional(static_cast<int>(found - known.begin()));
}

std::string ShaftsOfPair::table(int index) const {
  const std::string name = names()[static_cast<std::size_t>(index)];
  if (std::ranges::find(pair_shafts, name) != pair_shafts.end()) return name + ".shaft";
  return "unit.shafts." + std::to_string(index - (shaft.pinion ? 1 : 0) - (shaft.wheel ? 1 : 0));
}

bool ShaftsOfPair::depends_on_load() const {
  return std::ranges::any_of(all(), [](const ShaftData* data) { return std::ranges::any_of(data->bearings, &ShaftBearing::depends_on_load); }) ||
         std::ranges::any_of(unit.joints, [](const ShaftJoint& joint) { return joint.bearing.depends_on_load(); });
}

std::vector<Eigen::Vector2d> axes_of(const ShaftsOfPair& shafts, const GearPair& pair) {
  std::vector<Eigen::Vector2d> axes(shafts.all().size(), Eigen::Vector2d::Constant(not_given));
  const auto set = [&](std::optional<int> shaft, const Eigen::Vector2d& axis) {
    if (!shaft || axes[static_cast<std::size_t>(*shaft)].allFinite() || !axis.allFinite()) return false;
    axes[static_cast<std::size_t>(*shaft)] = axis;
    return true;
  };
  const auto of = [&](const std::string& name) -> Eigen::Vector2d { return axes[static_cast<std::size_t>(*shafts.find(name))]; };
  set(shafts.find(Member::Pinion), {0.0, 0.0});
  set(shafts.find(Member::Wheel), {pair.centre_distance, 0.0});
  for (bool found = true; found;) {
    found = false;
    for (const UnitMesh& mesh : shafts.unit.meshes) {
      const double distance = geometry_of(mesh).centre_distance;
      const Eigen::Vector2d apart(distance * std::cos(mesh.angle), distance * std::sin(mesh.angle));
      const std::string &one = mesh.gears[0].shaft, &two = mesh.gears[1].shaft;
      found = set(shafts.find(two), of(one) + apart) || set(shafts.find(one), of(two) - apart) || found;
    }
    for (const ShaftJoint& joint : shafts.unit.joints) {
      found = set(shafts.find(joint.shaft), of(joint.outer_shaft)) || set(shafts.find(joint.outer_shaft), of(joint.shaft)) || found;
    }
  }
  return axes;
}

ShaftsOfPair with_torques_reversed(ShaftsOfPair shafts) {
  for (UnitMesh& mesh : shafts.unit.meshes) mesh.torque = -mesh.torque;
  for (UnitLoad& load : shafts.unit.loads) {
    assert(load.keeps_direction());
    if (!load.constant) load.moment.z() = -load.moment.z();
  }
  return shafts;
}

namespace {

/// In the mirror forces along y and turns about x, which is axial, change their sign.
void mirror(ShaftBearing& bearing) {
  constexpr std::array<Eigen::Index, 2> turned{1, 3};
  if (!bearing.has_matrix()) return;
  for (const Eigen::Index i : turned) {
    bearing.stiffness_matrix.row(i) *= -1.0;
    bearing.stiffness_matrix.col(i) *= -1.0;
  }
}

}  // namespace

ShaftsOfPair mirrored(ShaftsOfPair shafts) {
  UnitData& unit = shafts.unit;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (shafts.shaft[m]) std::ranges::for_each(shafts.shaft[m]->bearings, mirror);
  }
  for (ShaftData& shaft : unit.shafts) std::ranges::for_each(shaft.bearings, mirror);
  for (ShaftJoint& joint : unit.joints) mirror(joint.bearing);
  for (UnitMesh& mesh : unit.meshes) {
    mesh.angle = -mesh.angle;
    mesh.hand = mesh.hand == Hand::Right ? Hand::Left : Hand::Right;
    mesh.torque = -mesh.torque;
  }
  for (UnitLoad& load : unit.loads) {
    load.force.y() *= -1.0;
    load.moment.x() *= -1.0;
    load.moment.z() *= -1.0;
  }
  for (Eigen::Index i = 1; i < unit.housing.stiffness.rows(); i += 3) {
    unit.housing.stiffness.row(i) *= -1.0;
    unit.housing.stiffness.col(i) *= -1.0;
  }
  return shafts;
}

}  // namespace flankwright
