#include "studies/tasks/analyse/analyse_task.hpp"

#include "studies/analysis/study_effects.hpp"
#include "studies/analysis/study_run.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/tasks/analyse/analyse_keys.hpp"
#include "studies/tasks/analyse/analyse_template.hpp"

namespace flankwright::studies {

namespace {

/// Beside the scenes a flank that has what derivatives are asked by: each modification other than 0, and nothing of a twist taken back.
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

}  // namespace

const Task analyse_task{.name = "analyse",
                        .meaning = "The task `analyse`.",
                        .one_design = true,
                        .keys = analyse_keys,
                        .read = read_gradients,
                        .check = check_gradients,
                        .conditions = analyse_conditions,
                        .run = [](StudyRun& run) { run.analyse(); },
                        .summary = analysis_table,
                        .study_template = analyse_template};

}  // namespace flankwright::studies
