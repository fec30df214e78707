#include "optimize/design/design_optimiser.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/base/stopwatch.hpp"
#include "optimize/design/search/least_excess.hpp"

namespace flankwright {

namespace {

std::string in_percent(double share) {
  std::ostringstream text;
  text << std::setprecision(3) << 100.0 * share << " %";
  return text.str();
}

void append(std::vector<SolverStep>& history, const std::vector<SolverStep>& more) {
  const int offset = history.empty() ? 0 : history.back().evaluation;
  for (SolverStep step : more) {
    step.evaluation += offset;
    history.push_back(step);
  }
}

/// No multipliers are looked for where a search was stopped at a design that exceeds a constraint by more than this part of its limit. Thousands of rows may
/// be broken there, and such a design is no optimum.
constexpr double far_outside = 0.1;

/// The least excess is sought from so many designs at least besides the nearest known, the starts of the study among them: every search is a local one.
constexpr int starts_by_excess = 5;

/// The whole run, its books and what is left of the budget.
class DesignRun {
 public:
  DesignRun(DesignProblem& problem, const DesignOptions& options) : problem_(problem), options_(options) {}

  DesignResult finish() {
    result_.solver = options_.solver.name;
    result_.finisher = options_.solver.finisher;
    result_.before = report_design(problem_, problem_.analyse_given());
    result_.evaluations = result_.failures = 0;
    first_objective();
    restore();
    DesignProblem last = later_objectives();
    // A design that exceeds the constraints is no optimum of the objective.
    const bool is_near_feasible = problem_.violation(problem_.analyse(x_, false)) <= far_outside;
    if (result_.status != SolverStatus::Infeasible && is_near_feasible) result_.optimality = first_order_optimality(last, x_);
    judge_stall();
    result_.gradient_evaluations = uses_gradients(options_.solver.name) ? result_.evaluations : 0;
    result_.after = report_design(problem_, problem_.analyse(x_, false));
    if (options_.to_grind) choose_what_to_grind(problem_, last, x_, left(), result_);
    result_.seconds = clock_.seconds();
    return std::move(result_);
  }

 private:
  SolverOptions left() const {
    SolverOptions options = options_.solver;
    options.max_evaluations = std::max(1, options.max_evaluations - result_.evaluations);
    options.max_seconds = std::max(1e-3, options.max_seconds - clock_.seconds());
    return options;
  }

  SolverOptions search_options() const {
    SolverOptions search = left();
    search.max_evaluations = std::min(search.max_evaluations, options_.most_search_analyses);
    return search;
  }

  bool is_spent() const { return result_.evaluations >= options_.solver.max_evaluations || clock_.seconds() >= options_.solver.max_seconds; }

  void take(const LocalRun& run) {
    violation_met_ = run.constraint_violation;
    result_.status = run.status;
    result_.message = run.message;
    result_.finished_by = run.finished_by;
    append(result_.history, run.history);
    x_ = run.x;
  }

  /// A search that no longer gained has converged where the first-order conditions of the task itself hold.
  void judge_stall() {
    if (result_.status != SolverStatus::Stalled || !result_.optimality.satisfied()) return;
    result_.status = SolverStatus::Converged;
    result_.message += "; but the first-order conditions hold to 1e-4: an optimum on it";
  }

  void first_objective() {
    if (options_.nearest_first && exceeds(problem_.start())) {
      x_ = problem_.start();
      result_.status = SolverStatus::Infeasible;
      result_.message = "no design that keeps the constraints was met";
      return;
    }
    result_.runs = run_from_starts(problem_, search_options(), options_.starts);
    result_.optima = distinct_optima(result_.runs, DesignResult::same_objective);
    for (const LocalRun& run : result_.runs) {
      result_.evaluations += run.evaluations;
      result_.failures += run.failures;
    }
    const LocalRun& best = result_.runs[best_run(result_.runs)];
    result_.formulation = best.epigraph ? "epigraph" : "direct";
    result_.rounds = best.rounds;
    take(best);
  }

  /// Whether a design is beyond limits so that the least excess is to be sought. Where a design beyond them is of no use, a search for the objective has
  /// looked for lower bounds long enough.
  bool exceeds(const Eigen::VectorXd& x) {
    const bool seeks_excess = options_.shows_nearest ? problem_.has_smooth_excess() : problem_.has_upper_bounds();
    return seeks_excess && problem_.violation(problem_.analyse(x, false)) > DesignLog::tolerance;
  }

  /// Starts of searches for the least excess beside the nearest design known: those of the study, and as many more as make `starts_by_excess`. None where a run
  /// before has had them.
  std::vector<Eigen::VectorXd> further_starts() const {
    if (options_.nearest_first || !options_.shows_nearest) return {};
    std::vector<Eigen::VectorXd> starts = space_filling_starts(problem_.start(), std::max(options_.starts, starts_by_excess), options_.solver.seed);
    std::erase_if(starts, [&](const Eigen::VectorXd& x) { return x == x_; });
    return starts;
  }

  /// Where no design that keeps the constraints was met: seeks the one that exceeds them by least, and goes on from there where that keeps them.
  void restore() {
    const bool keeps_lower_bounds = !problem_.has_upper_bounds() && violation_met_ <= DesignLog::tolerance;  // needs no analysis of its own
    if (keeps_lower_bounds || !exceeds(x_) || is_spent()) return;
    SolverOptions options = search_options();
    if (options_.solver.progress) {
      options.progress = [&, before = result_.evaluations](int analyses, double) { options_.solver.progress(before + analyses, not_given); };
    }
    const LeastExcess nearest = seek_least_excess(problem_, x_, {options, further_starts(), options_.shows_nearest});
    result_.evaluations += nearest.evaluations;
    result_.failures += nearest.failures;
    append(result_.history, nearest.history);
    x_ = nearest.x;
    if (!(nearest.excess > DesignLog::tolerance) && !is_spent()) {
      DesignProblem again = problem_;
      again.set_start(x_);
      const LocalRun run = run_local(again, search_options());
      result_.evaluations += run.evaluations;
      result_.failures += run.failures;
      take(run);
      return;
    }
    if (!nearest.ended_well) return;
    result_.status = SolverStatus::Infeasible;
    const bool keeps_bounds = problem_.violation(problem_.analyse(x_, false).modification) <= DesignLog::tolerance;
    result_.message = keeps_bounds ? message_of_excess(nearest.excess) : "no design that keeps the limits on modifications was found";
  }

  /// The problem of the last objective, at x_.
  DesignProblem later_objectives() {
    const DesignTask& task = problem_.task();
    DesignProblem stage = problem_;
    if (task.later_objectives.empty()) return stage;
    std::vector<ObjectiveBound> bounds = task.objective_bounds;
    Objective objective = task.combined_objective();
    for (const Objective& next : task.later_objectives) {
      const double least = stage.value(objective, stage.analyse(x_, false));
      const double limit = (1.0 + task.lexicographic_tolerance) * least;
      result_.stages.push_back({objective.name(), least, limit});
      bounds.push_back({objective, limit});
      objective = next;
      stage = problem_.judged_by(objective, bounds);
      stage.set_start(x_);
      if (is_spent()) continue;
      const LocalRun run = run_local(stage, left());
      result_.evaluations += run.evaluations;
      result_.failures += run.failures;
      take(run);
    }
    result_.stages.push_back({objective.name(), stage.value(objective, stage.analyse(x_, false))});
    return stage;
  }

  DesignProblem& problem_;
  const DesignOptions& options_;
  const Stopwatch clock_;
  DesignResult result_;
  Eigen::VectorXd x_;
  double violation_met_{not_given};  ///< at x_, as the search that found it has recorded it [-]
};

}  // namespace

double relative_increase(double from, double to) {
  const double increase = (to - from) / std::abs(from);
  return std::abs(increase) <= largest_increase ? increase : not_given;
}

std::string message_of_excess(double excess) {
  return "no design that keeps the constraints was found; the nearest found exceeds them by " + in_percent(excess);
}

DesignProblem last_stage(const DesignProblem& problem, const std::vector<LexicographicStage>& stages) {
  const DesignTask& task = problem.task();
  if (task.later_objectives.empty()) return problem;
  std::vector<ObjectiveBound> bounds = task.objective_bounds;
  Objective objective = task.combined_objective();
  for (std::size_t i = 0; i < task.later_objectives.size(); ++i) {
    bounds.push_back({objective, stages[i].limit});
    objective = task.later_objectives[i];
  }
  return problem.judged_by(objective, bounds);
}

void choose_what_to_grind(DesignProblem& problem, DesignProblem& last, const Eigen::VectorXd& x, const SolverOptions& options, DesignResult& result) {
  DesignToGrind found = design_to_grind(last, x, options);
  result.evaluations += found.analyses;
  result.failures += found.failures;
  if (found.x == x && !found.is_changed) return;
  if (found.is_changed) result.exact = result.after;  // else only a trace of an amount became nothing
  result.choices = std::move(found.choices);
  result.after = report_design(problem, problem.analyse(found.x, false));
}

DesignReport report_design(const DesignProblem& problem, DesignAnalysis analysis) {
  const DesignTask& task = problem.task();
  const auto value_of = [&](const DesignVariable& v) { return get(analysis.modification[v.member], v.parameter); };
  DesignReport report;
  for (const DesignVariable& v : task.variables) report.variables.push_back(value_of(v));
  for (const LinkingConstraint& link : task.links) report.linked.push_back(value_of(link.linked));
  report.scene_measures = problem.scene_measures(task.combined_objective(), analysis);
  for (const OutputConstraint& c : task.constraints) report.constraint_values.push_back(problem.constraint_value(analysis, c));
  for (const ModificationConstraint& c : task.modification_constraints) {
    report.modification_values.push_back(c.value(analysis.modification));
  }
  for (const Objective& objective : task.later_objectives) report.later_objectives.push_back(problem.value(objective, analysis));
  report.objective = problem.objective(analysis);
  problem.add_root_stress(analysis);
  report.analysis = std::move(analysis);
  return report;
}

DesignResult optimise_design(DesignProblem& problem, const DesignOptions& options) {
  options.solver.validate();
  if (options.starts < 1) throw InvalidInput("optimise.starts", std::to_string(options.starts), "an integer of at least 1");
  return DesignRun(problem, options).finish();
}

}  // namespace flankwright
