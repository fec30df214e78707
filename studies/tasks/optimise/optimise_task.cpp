#include "studies/study/task.hpp"

#include <fmt/format.h>

#include <cmath>

#include "studies/analysis/study_effects.hpp"
#include "studies/study_file/template_text.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/tasks/optimise/optimise_checks.hpp"
#include "studies/tasks/optimise/optimise_json.hpp"
#include "studies/tasks/optimise/optimise_keys.hpp"
#include "studies/tasks/optimise/optimise_reading.hpp"
#include "studies/tasks/optimise/optimise_report.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/tasks/optimise/optimise_run.hpp"
#include "studies/tasks/optimise/optimise_tables.hpp"
#include "studies/tasks/optimise/assessment_json.hpp"
#include "studies/tasks/optimise/assessment_keys.hpp"
#include "studies/tasks/optimise/assessment_reading.hpp"
#include "studies/tasks/optimise/grinding_choices.hpp"
#include "studies/tasks/optimise/grinding_limits.hpp"
#include "studies/tasks/optimise/results_store.hpp"
#include "studies/tasks/optimise/scatter_json.hpp"
#include "studies/tasks/optimise/scatter_keys.hpp"
#include "studies/tasks/optimise/scatter_reading.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

std::vector<SchemaKey> all_optimise_keys() {
  std::vector<SchemaKey> all = optimise_keys();
  for (SchemaKey& key : assessment_keys()) all.push_back(std::move(key));
  for (SchemaKey& key : grinding_limit_keys()) all.push_back(std::move(key));
  for (SchemaKey& key : scatter_keys()) all.push_back(std::move(key));
  return all;
}

void read_optimise_tables(StudyReading& reading) {
  read_optimise(reading);
  read_grinding_limits(reading);
  read_grinding_choices(reading);
  check_variables(reading);
  read_assessment(reading);
  read_scatter(reading);
}

std::vector<DesignVariable> varied_modifications(const Study& study) { return study.table<OptimiseTable>().varied(); }

/// Variables, and what is tied to them, count as modifications from the start, even where their first value is 0; of a compensation the least counts, which leaves
/// most twist. What scatters counts as well, with the design as it is given and with the variables.
std::vector<FlankCondition> optimise_conditions(const Study& study) {
  std::vector<FlankCondition> all = conditions_of(study);
  if (!study.tolerances.empty()) all.push_back(condition_of(study, widest_scene(study)));
  for (const FlankCondition& given : std::vector(all)) {
    FlankCondition& varied = all.emplace_back(given);
    for (const DesignVariable& v : varied_modifications(study)) {
      const bool least = of_process(v.parameter) != nullptr || v.upper == 0.0;
      set(varied.modification[v.member], v.parameter, least ? v.lower : v.upper);
    }
  }
  return all;
}

/// A quantile, or the mean beyond one, of fewer draws than one in which a single one lies beyond it; a standard deviation that is known to 10 % or worse.
void note_few_draws(const Study& study, std::vector<std::string>& notes) {
  const ScatterTable& scatter = study.table<OptimiseTable>().scatter;
  if (!scatter.asked()) return;
  if (scatter.statistic == Aggregate::MeanPlusSigmas && scatter.statistic.sigmas > 0.0 && scatter.draws <= 51) {
    const std::string known = scatter.draws > 1 ? fmt::format("known to {:.0f} % only", 100.0 / std::sqrt(2.0 * (scatter.draws - 1))) : "not known";
    notes.push_back(fmt::format("the standard deviation over {} draws is {}", scatter.draws, known));
  }
  const bool has_tail = scatter.statistic == Aggregate::Quantile || scatter.statistic == Aggregate::Cvar;
  if (!has_tail || scatter.draws * (1.0 - scatter.statistic.level) >= 1.0) return;
  notes.push_back(fmt::format("the {}{:g} % quantile over {} draws is the largest of them: it takes {:.0f} for one to lie beyond it",
                              scatter.statistic == Aggregate::Cvar ? "mean beyond the " : "", 100.0 * scatter.statistic.level, scatter.draws,
                              std::ceil(1.0 / (1.0 - scatter.statistic.level) - 1e-9)));
}

void add_optimise_json(const StudyResults& results, Json& json) {
  const OptimiseResults& found = optimised(results);
  json["optimise"] = optimise_json(results);
  const bool has_limits = results.study.table<OptimiseTable>().largest_amount || results.study.table<OptimiseTable>().steepest_relief;
  if (has_limits) json["optimise"]["grinding_limits"] = grinding_limits_json(found.task, found.design.after);
  if (found.task.grindable.any())
    json["optimise"]["grinding_choices"] = grinding_choices_json(found.design, found.task, statistic_of_choices(results));
  if (found.scatter) json["optimise"]["scatter"] = scatter_json(*found.scatter, found.task, results.study);
  add_assessment(found.assessment, found.task, results.study, json["optimise"]);
  json["optimise"]["comparison"]["optimum_objective"] = found.search_work.objective_at_positions;
}

void write_store(const StudyResults& results, const std::filesystem::path& folder) { write_results_store(folder / "results.sqlite", results); }

constexpr std::string_view optimise_head = R"(# Flank modifications that hold over a set of working conditions.
title = "My pair, as it should be"
task = "optimise"
)";

constexpr std::string_view optimise_tail = R"(
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

}  // namespace

extern const Task optimise_task{
    .name = "optimise",
    .meaning = "The task `optimise`: [optimisation](README.md#optimisation).",
    .keys = all_optimise_keys,
    .read = read_optimise_tables,
    .check = check_optimise,
    .conditions = optimise_conditions,
    .asks_for_root_stress = minimises_root_stress,
    .varied = varied_modifications,
    .add_notes = note_few_draws,
    .run = run_optimise,
    .write_files = write_store,
    .add_json = add_optimise_json,
    .tables = optimise_tables,
    .summary = optimise_summary,
    .report_sections = optimise_sections,
    .study_template = [] { return std::string(optimise_head) + std::string(template_pair) + std::string(optimise_tail); }};

}  // namespace flankwright::studies
