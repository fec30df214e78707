#include "studies/tasks/accuracy/accuracy_task.hpp"

#include "studies/analysis/study_run.hpp"
#include "studies/tasks/accuracy/accuracy_keys.hpp"
#include "studies/tasks/accuracy/accuracy_template.hpp"
#include "studies/tasks/accuracy/accuracy_json.hpp"
#include "studies/tasks/accuracy/accuracy_tables.hpp"

namespace flankwright::studies {

namespace {

void run_accuracy(StudyRun& run) {
  run.analyse();
  StudyResults& results = run.results();
  LevelRunner runner(run.level_subject(), run.progress());
  results.hierarchy = std::make_shared<const FidelityHierarchy>(run_hierarchy(runner, run.progress()));
  results.steps.push_back({"accuracy_ladder", "all fidelity levels together", results.hierarchy->seconds});
  if (!results.hierarchy->usable()) results.requirements.push_back("the finest fidelity level did not converge");
}

}  // namespace

const Task accuracy_task{.name = "accuracy",
                         .meaning = "The task `accuracy`: [the cost of accuracy](tasks/accuracy/README.md).",
                         .compares_bodies = true,
                         .keys = accuracy_keys,
                         .check = check_accuracy,
                         .run = run_accuracy,
                         .add_json = [](const StudyResults& results, Json& json) { json["accuracy"] = hierarchy_json(*results.hierarchy); },
                         .tables = [](const StudyResults& results) { return hierarchy_tables(*results.hierarchy); },
                         .summary = [](const StudyResults& results) { return hierarchy_summary(*results.hierarchy); },
                         .study_template = accuracy_template};

}  // namespace flankwright::studies
