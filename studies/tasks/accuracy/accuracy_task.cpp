#include "studies/tasks/accuracy/accuracy_task.hpp"

#include "studies/analysis/study_run.hpp"
#include "studies/tasks/accuracy/accuracy_keys.hpp"
#include "studies/tasks/accuracy/accuracy_template.hpp"
#include "studies/tasks/accuracy/ladder_json.hpp"
#include "studies/tasks/accuracy/ladder_tables.hpp"

namespace flankwright::studies {

namespace {

void run_accuracy(StudyRun& run) {
  run.analyse();
  StudyResults& results = run.results();
  RungRunner runner(run.rung_subject(), run.progress());
  results.ladder = std::make_shared<const Ladder>(climb_ladder(runner, run.progress()));
  results.steps.push_back({"accuracy_ladder", "all rungs of the ladder together", results.ladder->seconds});
  if (!results.ladder->usable()) results.requirements.push_back("the finest rung of the ladder did not converge");
}

}  // namespace

const Task accuracy_task{.name = "accuracy",
                         .meaning = "The task `accuracy`: [what accuracy costs](tasks/accuracy/README.md).",
                         .compares_bodies = true,
                         .keys = accuracy_keys,
                         .run = run_accuracy,
                         .add_json = [](const StudyResults& results, Json& json) { json["accuracy"] = ladder_json(*results.ladder); },
                         .tables = [](const StudyResults& results) { return ladder_tables(*results.ladder); },
                         .summary = [](const StudyResults& results) { return ladder_summary(*results.ladder); },
                         .study_template = accuracy_template};

}  // namespace flankwright::studies
