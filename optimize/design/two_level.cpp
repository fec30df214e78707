#include "optimize/design/two_level.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "optimize/design/design_log.hpp"
#include "optimize/design/task_checks.hpp"

namespace flankwright {

namespace {

/// The finisher needs some five to fifteen analyses from a neighbouring optimum; a kink may hold it up for longer than it is worth.
constexpr int most_fine_analyses = 40;
/// SolverOptions::tolerance of the coarse search is no less: its optimum is a start, and differs from the fine one by more.
constexpr double coarse_tolerance = 1e-4;

/// Likewise of the finisher: 1e-5 of a range of 100 um is 1 nm, far below what can be ground.
constexpr double fine_tolerance = 1e-5;

/// The best of the coarse optima, judged by the fine problem: feasible before infeasible, then by the objective.
Eigen::VectorXd best_start(DesignProblem& fine, const DesignResult& coarse, const Eigen::VectorXd& coarse_best) {
  std::vector<Eigen::VectorXd> candidates{coarse_best};
  for (const LocalOptimum& optimum : coarse.optima) candidates.push_back(coarse.runs[optimum.run].x);
  Eigen::VectorXd best = coarse_best;
  double least = INFINITY, least_violation = INFINITY;
  for (const Eigen::VectorXd& x : candidates) {
    const DesignAnalysis& analysis = fine.analyse(x, false);
    if (!std::ranges::all_of(analysis.cycles, [](const LoadedCycle& cycle) { return cycle.usable(); })) continue;
    const double objective = fine.objective(analysis), violation = std::max(0.0, fine.violation(analysis) - DesignLog::tolerance);
    if (!(violation < least_violation || (violation == least_violation && objective < least))) continue;
    best = x;
    least = objective;
    least_violation = violation;
  }
  return best;
}

void join(const DesignResult& coarse, DesignResult& fine) {
  const int fine_runs_start = coarse.history.empty() ? 0 : coarse.history.back().evaluation;
  fine.solver = coarse.solver;
  fine.finisher = coarse.finisher;
  fine.runs = coarse.runs;
  fine.optima = coarse.optima;
  fine.rounds = coarse.rounds;
  fine.formulation = coarse.formulation;
  if (fine.finished_by.empty()) fine.finished_by = coarse.finished_by;
  // Whether the constraints can be kept is judged by the fine level.
  const bool search_ended =
      coarse.status == SolverStatus::Converged || coarse.status == SolverStatus::Stalled || coarse.status == SolverStatus::Infeasible;
  if (!search_ended) {
    fine.status = coarse.status;
    fine.message = coarse.message;
  } else if (fine.status == SolverStatus::EvaluationLimit) {
    // The finisher's own limit: the coarse optimum had been found, and the best design that was met from there on is kept.
    fine.status = fine.optimality.satisfied() ? SolverStatus::Converged : SolverStatus::Stalled;
    fine.message =
        coarse.message + "; the fine level ended after " + std::to_string(most_fine_analyses) + " analyses with the best design it had met";
  }
  fine.seconds += coarse.seconds;
  fine.evaluations += coarse.evaluations;
  fine.gradient_evaluations += coarse.gradient_evaluations;
  fine.failures += coarse.failures;
  std::vector<SolverStep> history = coarse.history;
  for (SolverStep step : fine.history) {
    step.evaluation += fine_runs_start;
    history.push_back(step);
  }
  fine.history = std::move(history);
}

/// The budgets that a design leaves.
SolverOptions left_of(SolverOptions options, const DesignResult& found) {
  options.max_evaluations = std::max(1, options.max_evaluations - found.evaluations);
  options.max_seconds = std::max(1e-3, options.max_seconds - found.seconds);
  return options;
}

}  // namespace

bool can_be_coarser(const DesignTask& task) {
  const Quadrature& quadrature = task.resolution.quadrature;
  return quadrature.rule == QuadratureRule::Graded && quadrature.intervals >= 2 * fewest_search_intervals;
}

DesignTask coarser(DesignTask task) {
  int& intervals = task.resolution.quadrature.intervals;
  intervals = std::min(intervals / 2, most_search_intervals);
  std::vector<double>& phases = task.resolution.phases;
  const int positions = static_cast<int>(phases.size());
  if (positions > most_search_positions && phases == equally_spaced_phases(positions)) phases = equally_spaced_phases(most_search_positions);
  if (task.search_structure) task.structure = task.search_structure;
  if (!asks_for_root_stress(task)) task.root_stress = nullptr;  // to be shown it is not needed
  for (DesignVariable& variable : task.variables) variable.step = 0.0;
  task.grindable = {};
  return task;
}

TwoLevelDesign optimise_by_two_levels(DesignProblem& problem, const DesignOptions& options) {
  const Stopwatch clock;
  TwoLevelDesign result;
  result.fine.resolution = problem.task().resolution;
  const std::int64_t cycles_before = problem.cycles();
  if (!can_be_coarser(problem.task())) {
    result.design = optimise_design(problem, options);
    result.fine.cycles = problem.cycles() - cycles_before;
    result.fine.seconds = clock.seconds();
    result.search = result.fine;
    result.objective_seen_by_search = (result.design.exact ? *result.design.exact : result.design.after).objective;
    return result;
  }
  DesignProblem coarse_problem(coarser(problem.task()));
  DesignOptions search = options;
  search.solver.tolerance = std::max(options.solver.tolerance, coarse_tolerance);
  const DesignResult coarse = optimise_design(coarse_problem, search);
  result.search = {coarse_problem.task().resolution, coarse_problem.cycles(), clock.seconds()};
  result.objective_seen_by_search = coarse.after.objective;

  const Stopwatch fine_clock;
  result.design = coarse;
  problem.set_start(best_start(problem, coarse, problem.scaled_design(coarse.after.variables).cwiseMax(0.0).cwiseMin(1.0)));
  result.fine.cycles = problem.cycles() - cycles_before;
  go_on(problem, options, result);
  result.fine.seconds = fine_clock.seconds();
  result.design.seconds = clock.seconds();
  return result;
}

void go_on(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
  DesignOptions finish = options;
  finish.starts = 1;
  finish.solver = left_of(options.solver, found.design);
  finish.solver.name = options.solver.finisher == "none" ? options.solver.name : options.solver.finisher;
  finish.solver.finisher = "none";
  finish.solver.tolerance = std::max(options.solver.tolerance, fine_tolerance);
  finish.most_search_analyses = most_fine_analyses;
  const std::int64_t cycles_before = problem.cycles();
  DesignResult fine = optimise_design(problem, finish);
  found.fine.cycles += problem.cycles() - cycles_before;
  join(found.design, fine);
  found.design = std::move(fine);
}

void choose_what_to_grind(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
  const Stopwatch clock;
  DesignProblem last = last_stage(problem, found.design.stages);
  const Eigen::VectorXd x = problem.scaled_design(found.design.after.variables).cwiseMax(0.0).cwiseMin(1.0);
  const std::int64_t cycles_before = problem.cycles();
  choose_what_to_grind(problem, last, x, left_of(options.solver, found.design), found.design);
  found.fine.cycles += problem.cycles() - cycles_before;
  found.fine.seconds += clock.seconds();
  found.design.seconds += clock.seconds();
}

}  // namespace flankwright
