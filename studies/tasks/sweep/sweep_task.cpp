#include "studies/tasks/sweep/sweep_task.hpp"

#include "studies/analysis/study_effects.hpp"
#include "studies/analysis/study_run.hpp"
#include "studies/results/tables.hpp"
#include "studies/tasks/sweep/run_sweep.hpp"
#include "studies/tasks/sweep/sweep_design.hpp"
#include "studies/tasks/sweep/sweep_json.hpp"
#include "studies/tasks/sweep/sweep_keys.hpp"
#include "studies/tasks/sweep/sweep_reading.hpp"
#include "studies/tasks/sweep/sweep_statistics.hpp"
#include "studies/tasks/sweep/sweep_tables.hpp"
#include "studies/tasks/sweep/sweep_template.hpp"
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

}  // namespace

const Task sweep_task{.name = "sweep",
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
                      .study_template = sweep_template};

}  // namespace flankwright::studies
