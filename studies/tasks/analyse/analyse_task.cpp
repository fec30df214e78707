#include "studies/study/task.hpp"

#include "studies/analysis/study_effects.hpp"
#include "studies/analysis/study_run.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/study_file/template_text.hpp"
#include "studies/tasks/analyse/analyse_keys.hpp"

namespace flankwright::studies {

namespace {

/// The scenes, and one flank on which every modification that derivatives are asked by is other than 0 and no twist is compensated.
std::vector<FlankCondition> analyse_conditions(const Study& study) {
  constexpr double some = 1e-3;  // mm: whatever is not 0 counts
  std::vector<FlankCondition> all = conditions_of(study);
  FlankCondition moved = all.front();
  for (const GradientParameter& p : study.gradients) {
    const auto* of_gear = std::get_if<GearParameter>(&p.parameter);
    if (of_gear == nullptr || describe(of_gear->parameter).kind == ParameterKind::Extent) continue;
    set(moved.modification[of_gear->member], of_gear->parameter, of_process(of_gear->parameter) != nullptr ? 0.0 : some);
  }
  all.push_back(moved);
  return all;
}

constexpr std::string_view analyse_head =
    R"(# A loaded tooth contact analysis. Bare numbers have the unit in the comment; a text may carry its own: "0.1 mm".
title = "My pair, as it runs"
task = "analyse"
)";

constexpr std::string_view analyse_tail = R"(
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

}  // namespace

extern const Task analyse_task{.name = "analyse",
                               .meaning = "The task `analyse`.",
                               .one_design = true,
                               .keys = analyse_keys,
                               .read = read_gradients,
                               .check = check_gradients,
                               .conditions = analyse_conditions,
                               .run = [](StudyRun& run) { run.analyse(); },
                               .summary = analysis_table,
                               .study_template = [] { return std::string(analyse_head) + std::string(template_pair) + std::string(analyse_tail); }};

}  // namespace flankwright::studies
