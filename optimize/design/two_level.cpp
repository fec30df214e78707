#include "optimize/design/two_level.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/stopwatch.hpp"
#include "optimize/design/search/design_log.hpp"
#include "optimize/design/problem/joined_loads.hpp"
#include "optimize/design/problem/task_checks.hpp"

namespace flankwright {

namespace {

/// The finisher needs some five to fifteen analyses from a neighbouring optimum; a kink may hold it up for longer than it is worth.
constexpr int most_fine_analyses = 40;
/// SolverOptions::tolerance of the coarse search is no less: its optimum is a start, and differs from the fine one by more.
constexpr double coarse_tolerance = 1e-4;

/// Likewise of the finisher: 1e-5 of a range of 100 um is 1 nm, far below what can be ground.
constexpr double fine_tolerance = 1e-5;

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
    const std::string ended = "; the fine level ended after " + std::to_string(most_fine_analyses) + " analyses with the best design it had met";
    fine.message = coarse.message.ends_with(ended) ? coarse.message : coarse.message + ended;
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

/// Where the run from the given design ended, as the last of the starts: what finishes best is not known from the coarse level, and more starts shall not end
/// above that one alone.
void add_first_run(const DesignResult& coarse, std::vector<Eigen::VectorXd>& starts) {
  if (coarse.runs.size() < 2 || coarse.runs.front().x.size() == 0) return;
  const Eigen::VectorXd& first = coarse.runs.front().x;
  if (std::ranges::none_of(starts, [&](const Eigen::VectorXd& x) { return x == first; })) starts.push_back(first);
}

}  // namespace

SolverOptions left_of(SolverOptions options, const DesignResult& found) {
  options.max_evaluations = std::max(1, options.max_evaluations - found.evaluations);
  options.max_seconds = std::max(1e-3, options.max_seconds - found.seconds);
  return options;
}

std::vector<Eigen::VectorXd> best_starts(DesignProblem& problem, const DesignResult& found, const Eigen::VectorXd& x_found) {
  std::vector<Eigen::VectorXd> candidates{x_found};
  for (const LocalOptimum& optimum : found.optima) candidates.push_back(found.runs[optimum.run].x);
  const Eigen::VectorXd *lowest = nullptr, *nearest = nullptr;
  double least = INFINITY, least_violation = INFINITY, objective_of_nearest = INFINITY;
  for (const Eigen::VectorXd& x : candidates) {
    const DesignAnalysis& analysis = problem.analyse(x, false);
    if (!analysis.usable()) continue;
    const double objective = problem.objective(analysis), violation = std::max(0.0, problem.violation(analysis) - DesignLog::tolerance);
    if (objective < least) {
      least = objective;
      lowest = &x;
    }
    if (violation < least_violation || (violation == least_violation && objective < objective_of_nearest)) {
      least_violation = violation;
      objective_of_nearest = objective;
      nearest = &x;
    }
  }
  if (nearest == nullptr) return {x_found};
  if (lowest == nearest || !(least < objective_of_nearest)) return {*nearest};
  return {*nearest, *lowest};
}

void go_on_from_best(DesignProblem& problem, const DesignOptions& options, const std::vector<Eigen::VectorXd>& starts, TwoLevelDesign& found) {
  if (starts.size() == 1) {  // a copy of the cycles of all scenes takes as long as some analyses
    problem.set_start(starts.front());
    return go_on(problem, options, found);
  }
  const TwoLevelDesign before = found;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    TwoLevelDesign further = before;
    further.fine.cycles = found.fine.cycles;
    problem.set_start(starts[i]);
    go_on(problem, options, further);
    const bool keeps = further.design.status != SolverStatus::Infeasible, kept = found.design.status != SolverStatus::Infeasible;
    const bool is_lower = keeps && kept && further.design.after.objective < found.design.after.objective;
    const bool is_nearer_to_limits = !keeps && !kept && is_nearer(problem, further.design.after.analysis, found.design.after.analysis);
    if (i == 0 || (keeps && !kept) || is_lower || is_nearer_to_limits) {
      found = std::move(further);
    } else {
      found.fine.cycles = further.fine.cycles;
    }
  }
}

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
  DesignProblem coarse_problem(with_joined_loads(coarser(problem.task())).task);
  DesignOptions search = options;
  search.solver.tolerance = std::max(options.solver.tolerance, coarse_tolerance);
  DesignResult coarse = optimise_design(coarse_problem, search);
  result.search = {coarse_problem.task().resolution, coarse_problem.cycles(), clock.seconds()};
  result.objective_seen_by_search = coarse.after.objective;

  const Stopwatch fine_clock;
  const SolverStatus coarse_status = coarse.status;
  std::vector<Eigen::VectorXd> starts = best_starts(problem, coarse, problem.nearest_design(coarse.after.variables));
  add_first_run(coarse, starts);
  result.design = std::move(coarse);
  result.fine.cycles = problem.cycles() - cycles_before;
  go_on_from_best(problem, options, starts, result);
  const bool is_out_of_limits = result.design.status == SolverStatus::Infeasible && coarse_status != SolverStatus::Infeasible;
  if (is_out_of_limits && options.shows_nearest)  // only here: the coarse search has not sought the nearest design
    go_on_from_best(problem, options, {problem.nearest_design(result.design.after.variables)}, result);
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
  finish.nearest_first = found.design.status == SolverStatus::Infeasible;
  finish.shows_nearest = options.shows_nearest && finish.nearest_first;
  const std::int64_t cycles_before = problem.cycles();
  DesignResult fine = optimise_design(problem, finish);
  found.fine.cycles += problem.cycles() - cycles_before;
  if (found.confirmed) {
    found.fine.cycles += found.confirmed->work.cycles;
    found.fine.seconds += found.confirmed->work.seconds;
    found.confirmed.reset();
  }
  join(found.design, fine);
  found.design = std::move(fine);
}

void confirm(DesignProblem& problem, DesignProblem finer, DesignReport after, std::optional<DesignReport> exact, TwoLevelDesign& found) {
  DesignResult& design = found.design;
  if (!found.confirmed) {
    found.confirmed = {.work = found.fine, .problem = std::make_shared<const DesignProblem>(std::move(problem)), .design = exact_of(found)};
    found.fine = {.resolution = {}, .cycles = 0, .seconds = 0.0};
  }
  problem = std::move(finer);
  const int analyses = exact ? 2 : 1;
  found.fine.resolution = problem.task().resolution;
  found.fine.cycles += analyses * problem.scenes();
  design.evaluations += analyses;
  design.after = std::move(after);
  design.exact = std::move(exact);
  found.confirmed->objective_seen = exact_of(found).objective;
}

void complete_confirmed(DesignProblem& problem, TwoLevelDesign& found) {
  if (!found.confirmed) return;
  const Stopwatch clock;
  found.design.before = report_design(problem, problem.analyse_given());
  ++found.design.evaluations;
  found.fine.cycles += problem.scenes();
  found.fine.seconds += clock.seconds();
  found.design.seconds += clock.seconds();
}

void choose_what_to_grind(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
  const Stopwatch clock;
  DesignProblem last = last_stage(problem, found.design.stages);
  const Eigen::VectorXd x = problem.nearest_design(found.design.after.variables);
  const std::int64_t cycles_before = problem.cycles();
  choose_what_to_grind(problem, last, x, left_of(options.solver, found.design), found.design);
  found.fine.cycles += problem.cycles() - cycles_before;
  found.fine.seconds += clock.seconds();
  found.design.seconds += clock.seconds();
}

}  // namespace flankwright
