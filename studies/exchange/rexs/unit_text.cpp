#include "studies/exchange/rexs/unit_text.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"

namespace flankwright::studies::rexs {

namespace {

void write_material(const ShaftData& shaft, StudyText& text) {
  if (!std::isnan(shaft.material.youngs_modulus)) text.key("material.youngs_modulus", number_text(shaft.material.youngs_modulus));
  if (!std::isnan(shaft.material.poissons_ratio)) text.key("material.poissons_ratio", number_text(shaft.material.poissons_ratio));
}

}  // namespace

void write_unit(const ImportedUnit& imported, StudyText& text) {
  for (const Member m : {Member::Pinion, Member::Wheel}) write_shaft({*imported.shafts.shaft[m], imported.remarks[m]}, m, text);
  const UnitData& unit = imported.shafts.unit;
  if (unit.reference_torque > 0.0) {
    text.table("unit");
    text.key("reference_torque", number_text(unit.reference_torque / units::newton_metre), imported.reference_remark);
  }
  for (std::size_t i = 0; i < unit.shafts.size(); ++i) {
    const ShaftData& shaft = unit.shafts[i];
    text.list_table("unit.shafts");
    text.key("name", quoted(shaft.name), imported.shaft_remarks[i]);
    text.key("sections", sections_text(shaft));
    if (!shaft.bearings.empty()) text.key("bearings", bearings_text(shaft));
    if (!std::isnan(shaft.torque_position)) text.key("torque_position", difference_text(shaft.torque_position));
    write_material(shaft, text);
  }
  for (std::size_t i = 0; i < unit.meshes.size(); ++i) {
    const UnitMesh& mesh = unit.meshes[i];
    const auto remark = [&](const std::string& key) {
      const auto found = imported.mesh_remarks[i].find(key);
      return found == imported.mesh_remarks[i].end() ? std::string() : found->second;
    };
    text.list_table("unit.meshes");
    text.key("name", quoted(mesh.name));
    for (std::size_t g = 0; g < 2; ++g) {
      const std::string number = g == 0 ? "_1" : "_2";
      text.key("shaft" + number, quoted(mesh.gears[g].shaft));
      text.key("position" + number, difference_text(mesh.gears[g].position));
      text.key("teeth" + number, std::to_string(mesh.gears[g].teeth));
      if (mesh.gears[g].face_width > 0.0) text.key("face_width" + number, difference_text(mesh.gears[g].face_width));
    }
    text.key("normal_module", number_text(mesh.normal_module), remark("normal_module"));
    text.key("pressure_angle", number_text(mesh.pressure_angle / units::deg), remark("pressure_angle"));
    text.key("helix_angle", number_text(mesh.helix_angle / units::deg), remark("helix_angle"));
    text.key("hand_1", mesh.hand == Hand::Right ? "\"right\"" : "\"left\"", remark("pinion_hand"));
    if (!std::isnan(mesh.centre_distance)) text.key("centre_distance", number_text(mesh.centre_distance), remark("centre_distance"));
    text.key("angle", number_text(mesh.angle / units::deg), "by the shafts' support_vector");
    if (!std::isnan(mesh.torque)) text.key("torque_1", number_text(mesh.torque / units::newton_metre), remark("torque_1"));
  }
  for (std::size_t i = 0; i < unit.loads.size(); ++i) {
    const UnitLoad& load = unit.loads[i];
    text.list_table("unit.loads");
    text.key("shaft", quoted(load.shaft), imported.load_remarks[i]);
    text.key("position", difference_text(load.position));
    const char* const axes[] = {"x", "y", "z"};
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (load.force[k] != 0.0) text.key(std::string("force_") + axes[k], number_text(load.force[k]));
    }
    for (Eigen::Index k = 0; k < 2; ++k) {
      if (load.moment[k] != 0.0) text.key(std::string("moment_") + axes[k], number_text(load.moment[k] / units::newton_metre));
    }
    if (load.constant) text.key("constant", quoted("yes"));
  }
  for (std::size_t i = 0; i < unit.joints.size(); ++i) {
    const ShaftJoint& joint = unit.joints[i];
    text.list_table("unit.joints");
    text.key("shaft", quoted(joint.shaft), imported.joint_remarks[i]);
    text.key("position", difference_text(joint.bearing.position));
    text.key("outer_shaft", quoted(joint.outer_shaft));
    text.key("outer_position", difference_text(joint.outer_position));
    constexpr double newton_per_um = 1e3;  // [N/mm]
    if (std::isfinite(joint.bearing.radial_stiffness)) text.key("radial_stiffness", number_text(joint.bearing.radial_stiffness / newton_per_um));
    if (joint.bearing.axial_stiffness > 0.0) text.key("axial_stiffness", number_text(std::min(joint.bearing.axial_stiffness / newton_per_um, 1e9)));
    if (joint.bearing.tilting_stiffness > 0.0) text.key("tilting_stiffness", number_text(joint.bearing.tilting_stiffness / units::newton_metre));
  }
}

}  // namespace flankwright::studies::rexs
