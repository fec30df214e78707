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

}  // namespace flankwright::studies::small
