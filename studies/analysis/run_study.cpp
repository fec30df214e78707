#include "studies/analysis/run_study.hpp"

#include "studies/analysis/requirements.hpp"
#include "studies/analysis/study_run.hpp"

namespace flankwright::studies {

namespace {

/// Nothing where no accuracy is asked for, or nothing is loaded.
std::optional<FidelityChoice> fidelity_choice(const Study& study, const ProgressReport& progress) {
  if (!study.fidelity.accuracy || study.fidelity.compliance == ComplianceModel::Rigid || study.task->single_gears) return std::nullopt;
  LevelRunner runner(StudyRun(study, progress).level_subject(), progress);
  if (runner.subject().scenes.empty()) return std::nullopt;
  return choose_fidelity(runner, progress);
}

}  // namespace

StudyResults run_study(const Study& study, const ProgressReport& progress) {
  const std::optional<FidelityChoice> choice = fidelity_choice(study, progress);
  StudyResults results =
      choice ? StudyRun(with_choice(study, *choice), progress, choice->effects_budget()).finish() : StudyRun(study, progress).finish();
  if (!choice) return results;
  results.fidelity_choice = choice;
  results.fidelity_choice->left_out = results.left_out;
  results.steps.insert(results.steps.begin(),
                       {"accuracy_choice", "an accuracy is asked for: models and resolution by estimates", choice->choosing_seconds});
  results.seconds += choice->choosing_seconds;
  if (!choice->kept) results.requirements.push_back(unmet_accuracy(*choice));
  return results;
}

}  // namespace flankwright::studies
