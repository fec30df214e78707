#pragma once

#include <string>

namespace flankwright::studies {

/// A small spur pair by thin slices, and a strength of its flanks.
inline const std::string life_pair = R"(
[pair]
normal_module = 4
[pinion]
teeth = 20
face_width = 30
[wheel]
teeth = 40
face_width = 30
[cycle]
positions = 8
peaks = "sampled"
[fidelity]
compliance = "thin_slice"
effect_sizes = "off"
[fidelity.quadrature]
intervals = 6
)";

inline const std::string life_strength = R"(
[material]
contact_endurance_limit = 900
)";

/// Two loads of a spectrum, misaligned either way.
inline const std::string life_load = R"(
[load]
speed = 1500
spectrum = [{ torque = 300, hours = 10 }, { torque = 200, hours = 1000 }]
[[scenes]]
name = "one way"
misalignment.mesh_misalignment = 8
[[scenes]]
name = "other way"
misalignment.mesh_misalignment = -8
)";

}  // namespace flankwright::studies
