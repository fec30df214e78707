#include "studies/study/task.hpp"

#include "studies/analysis/study_effects.hpp"
#include "studies/analysis/study_run.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/template_text.hpp"
#include "studies/tasks/sweep/run_sweep.hpp"
#include "studies/tasks/sweep/sweep_design.hpp"
#include "studies/tasks/sweep/sweep_json.hpp"
#include "studies/tasks/sweep/sweep_keys.hpp"
#include "studies/tasks/sweep/sweep_reading.hpp"
#include "studies/tasks/sweep/sweep_statistics.hpp"
#include "studies/tasks/sweep/sweep_tables.hpp"
#include "studies/results/report_section.hpp"

namespace flankwright::studies {

namespace {

/// The ends of what is varied count beside the nominal sample.
std::vector<FlankCondition> sweep_conditions(const Study& study) {
  std::vector<FlankCondition> all = conditions_of(study);
  for (const SweptCondition& extreme : extreme_conditions(study)) all.push_back(extreme.flanks());
  return all;
}

void add_sweep_json(const StudyResults& results, Json& json) {
  if (results.found<SweepStatistics>() != nullptr) json["sweep"] = sweep_json(results);
}

std::string sweep_run_summary(const StudyResults& results) {
  return results.found<SweepStatistics>() != nullptr ? "nominal sample\n" + analysis_table(results) + "\n" + sweep_summary(results)
                                                     : analysis_table(results);
}

bool swept(const Json& r) { return has(r, "sweep") && r.at("sweep").is_object(); }

std::vector<ReportSection> sweep_sections() {
  return {
      {Chapter::Answer, "scatter", "Scatter over the samples", swept},
      {Chapter::Answer, "indices", "Causes of the scatter", [](const Json& r) { return swept(r) && r.at("sweep").value("index_blocks", 0) > 1; }},
      {Chapter::Answer, "response-maps", "Response maps", [](const Json& r) { return has(r, "sweep", "response_maps"); }},
  };
}

constexpr std::string_view sweep_head = R"(# Scatter of a pair's results by housing, torque and manufacture, and the contribution of each.
title = "My pair, as it comes off the line"
task = "sweep"
)";

constexpr std::string_view sweep_tail = R"(
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

}  // namespace

extern const Task sweep_task{.name = "sweep",
                             .meaning = "The task `sweep`: [sweeps](tasks/sweep/README.md).",
                             .keys = sweep_keys,
                             .read = read_sweep,
                             .check = check_sweep,
                             .conditions = sweep_conditions,
                             .run = [](StudyRun& run) { run.analyse(); },  // the nominal sample
                             .run_in_folder = run_sweep,
                             .add_json = add_sweep_json,
                             .tables = sweep_tables,
                             .summary = sweep_run_summary,
                             .report_sections = sweep_sections,
                             .study_template = [] { return std::string(sweep_head) + std::string(template_pair) + std::string(sweep_tail); }};

}  // namespace flankwright::studies
