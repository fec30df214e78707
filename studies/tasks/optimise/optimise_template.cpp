#include "studies/tasks/optimise/optimise_template.hpp"

#include "studies/study_file/template_text.hpp"

namespace flankwright::studies {

std::string optimise_template() {
  static constexpr std::string_view head = R"(# Flank modifications that hold over a set of working conditions.
title = "My pair, as it should be"
task = "optimise"
)";

  static constexpr std::string_view tail = R"(
[load]
torque = 300                         # N·m on the pinion

[cycle]
# positions = 64                     # mesh positions over one base pitch; left out: as many as the figures need

[fidelity]
compliance = "fitted"                # finite elements of both gears, solved once; "thin_slice": none, at once
# quadrature = { rule = "graded", intervals = 24 }                   # along a full contact line; left out: as fine as the figures need

# Each scene overrides what it names of [misalignment], [load], [pinion.error] and [wheel.error].
[[scenes]]
name = "aligned"

[[scenes]]
name = "housing bends"
misalignment.mesh_misalignment = 12  # um over the face width; + opens at +z
weight = 2                           # in mean and mean+2sigma

[[scenes]]
name = "part load, other way"
misalignment.mesh_misalignment = -8
load.torque = 120

[optimise]
objective = "peak_contact_stress"    # or te_peak_to_peak, te_harmonic_1 .. te_harmonic_10, load_factor, peak_line_load, peak_root_stress, edge_stress, tip_edge_share, edge_load
over = "worst"                       # nominal | worst | mean | mean+2sigma of the scenes
# solver = "ipopt"                   # left out: "nlopt:slsqp"; also nlopt:mma, nlopt:cobyla ...
# max_evaluations = 500
# max_seconds = "10 min"

[optimise.variables]                 # the search starts from the values above
"pinion.modification.lead_crowning" = [0, 30]                        # um
"pinion.modification.lead_slope" = [-20, 20]
"pinion.modification.tip_relief.amount" = [0, 40]

[optimise.constraints]
"te_peak_to_peak" = { max = 10 }     # um
)";

  return std::string(head) + std::string(template_pair) + std::string(tail);
}

}  // namespace flankwright::studies
