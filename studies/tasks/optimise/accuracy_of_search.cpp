#include <algorithm>
#include <numeric>

#include "core/base/stopwatch.hpp"
#include "optimize/design/more_intervals.hpp"
#include "optimize/design/search/design_log.hpp"
#include "studies/analysis/refine_resolution.hpp"
#include "studies/tasks/optimise/optimise_search.hpp"

namespace flankwright::studies {

bool OptimiseSearch::needs_finer_resolution(const DesignProblem& problem, const DesignReport& report) {
  std::vector<ResolvedCycle> resolved = resolved_cycles(problem, report.analysis, true);
  std::vector<DesignScene> scenes;
  for (int i = 0; i < problem.scenes(); ++i) scenes.push_back(scene_of(report.analysis, i));
  std::vector<StudyRun::HeldCase> held;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const DesignScene& scene = scenes[i];
    const JudgedCase judged{scene.name, scene.torque, &problem.model(static_cast<int>(i)), &report.analysis.cycles[i], &resolved[i]};
    held.push_back({judged, &scene.condition, &resolved[i], scene.operation, true});
  }
  if (may_look_finer()) run_.hold_against_finer(held);
  std::vector<JudgedCase> cases;
  for (const StudyRun::HeldCase& of : held) cases.push_back(of.judged);
  constexpr int most_doublings = 2;  // a search at a level between would be left anyway
  if (!refine_resolution(cases, results_, most_doublings)) return false;
  run_.set_intervals(results_.study.fidelity.quadrature.intervals);  // and the positions with them
  task_ = design_task();
  return true;
}

void OptimiseSearch::keep_accuracy(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
  while (results_.fidelity_choice && exact_of(found).analysis.usable()) {
    const Stopwatch clock;
    const double seconds = found.design.seconds;
    if (!needs_finer_resolution(problem, exact_of(found))) return;
    const Eigen::VectorXd x = problem.nearest_design(exact_of(found).variables);
    if (!is_confirmed(problem, x, found)) go_on_at_resolution(problem, options, x, found);
    found.fine.seconds += clock.seconds();
    found.design.seconds = seconds + clock.seconds();
  }
}

bool OptimiseSearch::is_confirmed(DesignProblem& problem, const Eigen::VectorXd& x, TwoLevelDesign& found) {
  if (!problem.task().later_objectives.empty()) return false;
  DesignProblem finer(task_);
  DesignReport seen = report_design(finer, finer.analyse(x, false));
  const bool infeasible = found.design.status == SolverStatus::Infeasible;
  const bool keeps_limits = infeasible || finer.violation(seen.analysis) <= DesignLog::tolerance;
  std::vector<int> all(task_.scenes.size());
  std::iota(all.begin(), all.end(), 0);
  if (!seen.analysis.usable() || !keeps_limits || is_turned(task_, exact_of(found), seen, all, infeasible, *results_.study.fidelity.accuracy))
    return false;
  confirm(problem, std::move(finer), std::move(seen), std::nullopt, found);
  return true;
}

void OptimiseSearch::show_accurately(DesignProblem& problem, TwoLevelDesign& found) {
  while (results_.fidelity_choice && found.design.after.analysis.usable()) {
    const Stopwatch clock;
    if (!needs_finer_resolution(problem, found.design.after)) return;
    DesignTask task = problem.task();  // its limits may be tighter than those of task_
    task.resolution = task_.resolution;
    DesignProblem finer(std::move(task));
    const auto seen = [&](const DesignReport& report) { return report_design(finer, finer.analyse_design(report.analysis.modification)); };
    DesignReport after = seen(found.design.after);
    std::optional<DesignReport> exact = found.design.exact ? std::optional(seen(*found.design.exact)) : std::nullopt;
    confirm(problem, std::move(finer), std::move(after), std::move(exact), found);
    found.fine.seconds += clock.seconds();
    found.design.seconds += clock.seconds();
  }
}

}  // namespace flankwright::studies
