#include "studies/tasks/sweep/sweep_template.hpp"

#include "studies/study_file/template_text.hpp"

namespace flankwright::studies {

std::string sweep_template() {
  static constexpr std::string_view head = R"(# Scatter of a pair's results by housing, torque and manufacture, and the contribution of each.
title = "My pair, as it comes off the line"
task = "sweep"
)";

  static constexpr std::string_view tail = R"(
[load]
torque = 300                         # N·m on the pinion; one for a sweep, more in [sweep.parameters]

[cycle]
# positions = 64                     # mesh positions over one base pitch; left out: as many as the figures need

[fidelity]
compliance = "fitted"                # finite elements of both gears, solved once; "thin_slice": none, at once
# quadrature = { rule = "graded", intervals = 24 }                   # along a full contact line; left out: as fine as the figures need

[sweep]
samples = 1000
sampler = "sobol"                    # or "latin_hypercube", "monte_carlo"; "grid": every combination of levels
seed = 1                             # another seed, other samples
# indices = "off"                    # all samples independent, but no Sobol indices

# Scattered parameters, in the unit of their keys. Also { truncated_normal = [mean, deviation, low, high] }, { grid = [low, high, levels] } and
# { values = [...] }. A parameter without a value above has its median in the nominal sample.
[sweep.parameters]
"misalignment.mesh_misalignment" = { normal = [0, 6] }               # um: mean, standard deviation
"load.torque" = { uniform = [250, 350] }                             # N·m
"pinion.error" = { iso_1328_class = 6 }                              # helix slope, profile slope and pitch, within their tolerances
"wheel.error.helix_slope" = { iso_1328_class = 6 }
# "pinion.modification.lead_crowning" = { uniform = [4, 8] }

# An interrupted run continues when it is started again. Expected results, for `flankwright test`:
# [expect]
# "sweep.statistics.peak_contact_stress_MPa.quantiles.99 %" = { max = 900 }
)";

  return std::string(head) + std::string(template_pair) + std::string(tail);
}

}  // namespace flankwright::studies
