#include "studies/tasks/accuracy/accuracy_template.hpp"

#include "studies/study_file/template_text.hpp"

namespace flankwright::studies {

std::string accuracy_template() {
  static constexpr std::string_view head =
      R"(# The cost of accuracy: the pair is analysed at many fidelity levels, and each is compared with the finest.
title = "My pair at all fidelity levels"
task = "accuracy"
)";

  static constexpr std::string_view tail = R"(
[load]
torque = 300                         # N·m on the pinion

[cycle]
# positions = 64                     # mesh positions over one base pitch; left out: as many as the figures need

[fidelity]                           # the settings of the study are one of the levels, too
compliance = "fitted"                # finite elements of both gears, solved once; "thin_slice": none, at once
# quadrature = { rule = "graded", intervals = 24 }                   # along a full contact line; left out: as fine as the figures need
# accuracy = "1 %"                   # chooses compliance, gap, quadrature and positions where they are not given

[accuracy.finest]                    # the level that all others are compared with
compliance = "fitted"                # or "fe", finer finite elements: minutes; "thin_slice": at once
# gap = "plane_of_action"            # by default contact is sought over the whole flanks
# intervals = 32                     # along a full contact line: 16, unless said
# positions = 128                    # over one base pitch: 64, unless said

# Errors are the worst over these; each overrides what it names.
[[scenes]]
name = "aligned"

[[scenes]]
name = "housing bends"
misalignment.mesh_misalignment = 12  # um over the face width; + opens at +z
)";

  return std::string(head) + std::string(template_pair) + std::string(tail);
}

}  // namespace flankwright::studies
