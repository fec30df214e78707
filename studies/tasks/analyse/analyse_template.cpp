#include "studies/tasks/analyse/analyse_template.hpp"

#include "studies/study_file/template_text.hpp"

namespace flankwright::studies {

std::string analyse_template() {
  static constexpr std::string_view head =
      R"(# A loaded tooth contact analysis. Bare numbers have the unit in the comment; a text may carry its own: "0.1 mm".
title = "My pair, as it runs"
task = "analyse"
)";

  static constexpr std::string_view tail = R"(
[misalignment]
crossing = 1                         # arcmin, out of the plane of the axes; + closes the right flank at +z
# intersecting = 1                   # arcmin, in the plane of the axes; + opens the mesh at +z
# centre_distance = 0.05             # mm, + apart
# axial_offset = 0.5                 # mm, wheel towards +z
# mesh_misalignment = 10             # um over the face width; + opens at +z

[load]
torque = [0, 150, 300]               # N·m on the pinion; each is run, 0 is the unloaded contact

[unloaded]
# marking_thickness = 6.35           # um: of the compound that shows the bearing pattern

[cycle]
# positions = 64                     # mesh positions over one base pitch; left out: as many as the figures need

[fidelity]
compliance = "fitted"                # finite elements of both gears, solved once; "fe": finer ones; "thin_slice": none, at once
# quadrature = { rule = "graded", intervals = 24 }                   # along a full contact line; left out: as fine as the figures need
# gap = "whole_surface"              # contact sought over the whole flanks, not only where undisturbed ones would touch
# effects = ["bending", "hertzian_contact"]                          # "auto" decides from the study

# What the results must say, for `flankwright test`:
# [expect]
# "loaded.summary.te_peak_to_peak_um" = { max = 3 }
)";

  return std::string(head) + std::string(template_pair) + std::string(tail);
}

}  // namespace flankwright::studies
