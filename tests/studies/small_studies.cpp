#include "tests/studies/small_studies.hpp"

namespace flankwright::studies::small {

namespace {

const std::string pair = R"(
[pair]
normal_module = 10
helix_angle = 30
[pinion]
teeth = 18
face_width = 120
[wheel]
teeth = 54
face_width = 120
[material]
youngs_modulus = 209000
[cycle]
positions = 6
[fidelity]
compliance = "thin_slice"
quadrature.intervals = 6
)";

}  // namespace

std::string analysis() {
  return "title = \"small analysis\"\n" + pair + R"(
[pinion.modification]
lead_crowning = 8
tip_relief = { amount = 10, height = 3 }
[pinion.error]
pitch = 2
[load]
torque = [0, 1014.868]
[[scenes]]
name = "aligned"
[[scenes]]
name = "bent"
misalignment.mesh_misalignment = 12
)";
}

std::string optimisation() {
  return "title = \"small optimisation\"\ntask = \"optimise\"\n" + pair + R"(
[pinion.modification]
end_relief = { amount = 0, length = 10 }
[load]
torque = 1014.868
[[scenes]]
name = "aligned"
[[scenes]]
name = "bent"
misalignment.mesh_misalignment = 12
weight = 2
[[scenes]]
name = "bent back"
misalignment.mesh_misalignment = -12
[optimise]
objective = "peak_contact_stress"
[optimise.variables]
"pinion.modification.lead_crowning" = [0, 40]
"pinion.modification.lead_slope" = [-20, 20]
"pinion.modification.end_relief.length" = [5, 30]
"pinion.modification.end_relief.amount" = [0, 20]
[optimise.constraints]
te_peak_to_peak = { max = 5 }
)";
}

std::string helical_pair(const std::string& of_pair, const std::string& of_pinion, const std::string& torque) {
  return R"([pair]
normal_module = 4
helix_angle = 15
)" + of_pair +
         R"([pinion]
teeth = 21
face_width = 40
)" + of_pinion +
         R"([wheel]
teeth = 40
face_width = 40
[load]
torque = )" +
         torque + R"(
[cycle]
positions = 4
[fidelity]
compliance = "thin_slice"
)";
}

std::string unit_pair() {
  return helical_pair("working_flank = \"left\"\n", "hand = \"left\"\n") + R"(quadrature = { rule = "graded", intervals = 12 }
[pinion.shaft]
sections = [{ length = 180, outer_diameter = 50 }]
bearings = [{ position = 10, radial_stiffness = 800 }, { position = 170, radial_stiffness = 400 }]
gear_position = 130
)";
}

std::string unit() {
  return R"([[unit.shafts]]
name = "input"
sections = [{ length = 100, outer_diameter = 40 }, { length = 60, outer_diameter = 45 }]
bearings = [{ position = 20 }, { position = 150 }]
torque_position = 0
[[unit.meshes]]
name = "first"
shaft_1 = "input"
position_1 = 60
teeth_1 = 20
shaft_2 = "pinion"
position_2 = 50
teeth_2 = 50
normal_module = 3
helix_angle = 20
angle = 70
)";
}

std::string crowned_pair() {
  return R"([pair]
normal_module = 4
helix_angle = 15
[pinion]
teeth = 20
face_width = 20
modification.lead_crowning = 6
[wheel]
teeth = 40
face_width = 20
)";
}

std::string spur_pair() {
  return R"([pair]
normal_module = 3
[pinion]
teeth = 25
face_width = 20
[wheel]
teeth = 50
face_width = 20
)";
}

std::string tilted_spur_pair() {
  return R"([pair]
normal_module = 3
[pinion]
teeth = 20
face_width = 20
profile_shift = 0.2
modification = { lead_crowning = 6, lead_slope = 3, tip_relief = { amount = 15, height = 1.5 } }
[wheel]
teeth = 41
face_width = 22
profile_shift = 0.1
modification = { tip_relief = { amount = 12, height = 1.2 } }
[misalignment]
mesh_misalignment = 5
[load]
torque = 200
[fidelity]
compliance = "thin_slice"
effect_sizes = "off"
)";
}

}  // namespace flankwright::studies::small
