#include "studies/results/unit_json.hpp"

#include <algorithm>

#include "studies/results/shaft_json.hpp"

namespace flankwright::studies {

namespace {

Json vector_json(const auto& vector, double unit = 1.0) {
  Json json = Json::array();
  for (const double part : vector) json.push_back(part / unit);
  return json;
}

Json further_shaft_json(const ShaftData& shaft) {
  Json json = shaft_json(shaft);
  json.erase("gear_position_mm");
  json.erase("gear_stiffens");
  json["name"] = shaft.name;
  return json;
}

Json mesh_json(const UnitMesh& mesh) {
  const MeshGeometry geometry = geometry_of(mesh);
  Json json{{"name", mesh.name},
            {"normal_module_mm", mesh.normal_module},
            {"pressure_angle_deg", in_deg(mesh.pressure_angle)},
            {"helix_angle_deg", in_deg(mesh.helix_angle)},
            {"hand_1", mesh.hand == Hand::Right ? "right" : "left"},
            {"centre_distance_mm", geometry.centre_distance},
            {"angle_deg", in_deg(mesh.angle)},
            {"torque_1_Nm", in_Nm(mesh.torque)},
            {"stiffness_N_per_mm_um", mesh.stiffness * units::um}};
  for (std::size_t g = 0; g < 2; ++g) {
    const std::string number = g == 0 ? "_1" : "_2";
    json["shaft" + number] = mesh.gears[g].shaft;
    json["position" + number + "_mm"] = mesh.gears[g].position;
    json["teeth" + number] = mesh.gears[g].teeth;
    json["face_width" + number + "_mm"] = mesh.gears[g].face_width;
    json["working_pitch_diameter" + number + "_mm"] = 2.0 * geometry.working_radius[g];
  }
  return json;
}

Json mesh_state_json(const MeshState& mesh) {
  return {{"name", mesh.name},
          {"shaft_1", mesh.shafts[0]},
          {"shaft_2", mesh.shafts[1]},
          {"torque_1_Nm", in_Nm(mesh.torque[0])},
          {"torque_2_Nm", in_Nm(mesh.torque[1])},
          {"normal_force_N", mesh.normal_force},
          {"force_on_2_N", vector_json(mesh.force)},
          {"flank_1", mesh.torque[0] == 0.0 ? Json() : Json(name_of(mesh.first_flank))},
          {"driver", mesh.driver < 0 ? Json() : Json(mesh.shafts[static_cast<std::size_t>(mesh.driver)])},
          {"misalignment_um", in_um(mesh.misalignment)},
          {"face_load_factor", mesh.face_load_factor}};
}

/// What was given and what the loaded contact has.
Json law_state_json(const BearingLawState& law) {
  constexpr double N_per_um = 1000.0;  // N/mm
  const auto stiffness = [](double value) { return value / N_per_um; };
  Json json{{"given", law.type == BearingType::NotGiven ? "force_table" : name_of(law.type)},
            {"deflection_um", in_um(law.deflection)},
            {"secant_N_per_um", stiffness(law.secant)},
            {"used_N_per_um", stiffness(law.tangent)},
            {"used_across_N_per_um", stiffness(law.across)}};
  if (law.type == BearingType::NotGiven) json["beyond_table"] = law.beyond_table;
  return json;
}

Json bearing_state_json(const BearingState& bearing) {
  Json json{{"name", bearing.name},
            {"shaft", bearing.shaft},
            {"outer_shaft", bearing.outer_shaft.empty() ? Json() : Json(bearing.outer_shaft)},
            {"position_mm", bearing.position},
            {"force_N", vector_json(bearing.force)},
            {"radial_force_N", bearing.force.head<2>().norm()},
            {"axial_force_N", bearing.force.z()},
            {"moment_Nm", vector_json(bearing.moment, units::newton_metre)},
            {"carries", bearing.carries}};
  if (bearing.radial_clearance > 0.0) {
    json["radial_clearance_um"] = in_um(bearing.radial_clearance);
    json["shift_um"] = vector_json(bearing.shift, units::um);
  }
  if (bearing.law) json["radial_stiffness"] = law_state_json(*bearing.law);
  return json;
}

Json shaft_state_json(const ShaftState& shaft) {
  constexpr double microradian = 1e-6;
  Json x = Json::array(), y = x, z = x, turn_x = x, turn_y = x, twist = x;
  double largest = 0.0;
  for (std::size_t i = 0; i < shaft.z.size(); ++i) {
    const Eigen::Vector3d &moved = shaft.displacement[i], &turned = shaft.turn[i];
    x.push_back(in_um(moved.x()));
    y.push_back(in_um(moved.y()));
    z.push_back(in_um(moved.z()));
    turn_x.push_back(turned.x() / microradian);
    turn_y.push_back(turned.y() / microradian);
    twist.push_back(turned.z() / microradian);
    largest = std::max(largest, moved.head<2>().norm());
  }
  return {{"name", shaft.name},
          {"axis_mm", vector_json(shaft.axis)},
          {"coupling_torque_Nm", in_Nm(shaft.coupling_torque)},
          {"held_against_turning_mm", shaft.turning_hold},
          {"largest_deflection_um", in_um(largest)},
          {"equilibrium_residual", shaft.residual},
          {"z_mm", vector_json(shaft.z)},
          {"x_um", std::move(x)},
          {"y_um", std::move(y)},
          {"axial_um", std::move(z)},
          {"turn_x_urad", std::move(turn_x)},
          {"turn_y_urad", std::move(turn_y)},
          {"twist_urad", std::move(twist)}};
}

}  // namespace

Json unit_json(const UnitData& unit) {
  return {{"reference_torque_Nm", in_Nm(unit.reference_torque)},
          {"shafts", list(unit.shafts, further_shaft_json)},
          {"meshes", list(unit.meshes, mesh_json)},
          {"loads", list(unit.loads,
                         [](const UnitLoad& load) -> Json {
                           return {{"shaft", load.shaft},
                                   {"position_mm", load.position},
                                   {"force_N", vector_json(load.force)},
                                   {"moment_Nm", vector_json(load.moment, units::newton_metre)},
                                   {"constant", load.constant}};
                         })},
          {"joints", list(unit.joints,
                          [](const ShaftJoint& joint) -> Json {
                            Json json = bearing_json(joint.bearing);
                            json["shaft"] = joint.shaft;
                            json["outer_shaft"] = joint.outer_shaft;
                            json["outer_position_mm"] = joint.outer_position;
                            return json;
                          })},
          {"housing", unit.housing.seats.empty() ? Json("rigid") : Json(unit.housing.seats)}};
}

Json unit_state_json(const UnitState& state) {
  Json json{{"bearings_are", state.linear ? "linear" : "linearised at their equilibrium under mean forces"},
            {"mesh_misalignment_um", in_um(state.mesh_misalignment)},
            {"misalignment_by_other_forces_um", in_um(state.outside_misalignment)},
            {"meshes", list(state.meshes, mesh_state_json)},
            {"bearings", list(state.bearings, bearing_state_json)},
            {"shafts", list(state.shafts, shaft_state_json)}};
  if (!state.linear) {
    const bool by_load = std::ranges::any_of(state.bearings, [](const BearingState& bearing) { return bearing.law.has_value(); });
    json[by_load ? "equilibrium" : "clearances"] = {
        {"converged", state.converged}, {"residual", state.clearance_residual}, {"iterations", state.iterations}};
  }
  return json;
}

}  // namespace flankwright::studies
