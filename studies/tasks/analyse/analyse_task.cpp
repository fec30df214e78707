#include "studies/tasks/analyse/analyse_task.hpp"

#include "studies/analysis/study_effects.hpp"
#include "studies/analysis/study_run.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/tasks/analyse/analyse_keys.hpp"
#include "studies/tasks/analyse/analyse_template.hpp"

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
