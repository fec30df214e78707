#pragma once

#include <string>

/// Sweeps of a real pair, coarse enough that a sample takes a fraction of a millisecond.
namespace flankwright::studies::small {

/// Haddad's helical pair 18:54 over mesh misalignment, torque and lead crowning.
/// @param settings  lines of [sweep]: "samples = 100"
/// @param more      lines of [sweep.parameters] beside these three
inline std::string sweep(const std::string& settings, const std::string& more = "") {
  return R"(title = "a small sweep"
task = "sweep"
[pair]
normal_module = 10
helix_angle = 30
[pinion]
teeth = 18
face_width = 120
[wheel]
teeth = 54
face_width = 120
[load]
torque = 1014.868
[cycle]
positions = 4
[fidelity]
compliance = "thin_slice"
quadrature = { rule = "gauss2", intervals = 3 }
[sweep]
)" + settings +
         R"(
[sweep.parameters]
"misalignment.mesh_misalignment" = { normal = [0, 6] }
"load.torque" = { uniform = [800, 1200] }
"pinion.modification.lead_crowning" = { uniform = [4, 12] }
)" + more;
}

}  // namespace flankwright::studies::small
