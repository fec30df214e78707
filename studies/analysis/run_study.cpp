#include "studies/analysis/run_study.hpp"

#include "studies/analysis/study_run.hpp"

namespace flankwright::studies {

namespace {

/// Nothing where no accuracy is asked for, or nothing is loaded.
std::optional<FidelityChoice> model_choice(const Study& study, const ProgressReport& progress) {
  if (!study.fidelity.accuracy || study.fidelity.compliance == ComplianceModel::Rigid) return std::nullopt;
  if (study.task->single_gears || study.task->loads_nothing) return std::nullopt;
  LevelRunner runner(StudyRun(study, progress).level_subject(), progress);
  if (runner.subject().scenes.empty()) return std::nullopt;
  return choose_models(runner, progress);
}

}  // namespace

StudyResults run_study(const Study& study, const ProgressReport& progress) {
  const std::optional<FidelityChoice> choice = model_choice(study, progress);
  if (!choice) return StudyRun(study, progress).finish();
  StudyResults results = StudyRun(with_models(study, *choice), progress, choice).finish();
  results.steps.insert(results.steps.begin(), {"accuracy_choice", "an accuracy is asked for: models by estimates", choice->choosing_seconds});
  results.seconds += choice->choosing_seconds;
  return results;
}

}  // namespace flankwright::studies
