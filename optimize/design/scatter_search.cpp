#include "optimize/design/scatter_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/base/stopwatch.hpp"
#include "optimize/design/direct_program.hpp"
#include "optimize/design/local_run.hpp"
#include "optimize/design/rounding.hpp"
#include "optimize/design/two_level.hpp"
#include "optimize/solvers/solver.hpp"

namespace flankwright {

namespace {

constexpr int most_turns = 8;           // searches over some of the draws on one level
constexpr double settled = 1e-4;        // a turn that lowers the statistic by no more than this share of it is the last
constexpr double tail_width = 3.0;      // draws searched over, in units of the share beyond the level
constexpr std::size_t least_tail = 8;   // of them at least
constexpr double leading_share = 0.15;  // DesignTask::leading_share of a search that begins near its optimum
constexpr int most_mean_analyses = 60;  // of the statistic of all draws, per level
constexpr int most_rounding_cycles = 6000;

/// Only the worst draws decide.
bool is_of_tail(const Aggregation& over) { return over == Aggregate::Cvar || over == Aggregate::Quantile || over == Aggregate::Worst; }

std::vector<double> measures_of(const DesignProblem& problem, const Objective& objective, const DesignAnalysis& analysis) {
  std::vector<double> measures;
  for (int s = 0; s < problem.scenes(); ++s) measures.push_back(problem.scene_measure(objective, analysis, s));
  return measures;
}

class DrawSearch {
 public:
  DrawSearch(const SolverOptions& options, ScatterDesign& books) : options_(options), books_(books) {}

  /// The best design on one level, from x on; over the draws it was searched over last.
  Eigen::VectorXd search(DesignProblem& full, Eigen::VectorXd x) {
    draws_.clear();
    double value = judge(full, x), violation = full.violation(full.analyse(x, false));
    grow(full, x);
    for (int turn = 0; turn < most_turns && !is_spent(); ++turn) {
      ++books_.turns;
      DesignProblem part = reduced(full);
      part.set_start(x);
      const Eigen::VectorXd next = is_of_tail(full.task().over) ? by_epigraph(part) : by_gradient(part);
      books_.cycles += std::int64_t{part.analyses()} * part.scenes();
      used_ += part.analyses();
      const double new_value = judge(full, next), new_violation = full.violation(full.analyse(next, false));
      const bool rises = grow(full, next);
      const double gain = value - new_value;
      const bool keeps = new_violation <= DesignLog::tolerance, kept = violation <= DesignLog::tolerance;
      const bool better = keeps == kept ? (keeps ? gain > 0.0 : new_violation < violation) : keeps;
      if (better) {
        x = next;
        value = new_value;
        violation = new_violation;
      }
      if (!rises && gain <= settled * std::abs(value)) break;
    }
    return x;
  }

  /// The task over the draws searched over, with levels that leave the statistic what it is.
  DesignProblem reduced(const DesignProblem& full) const {
    if (draws_.size() == static_cast<std::size_t>(full.scenes())) return full;
    const std::vector<int> some(draws_.begin(), draws_.end());
    const std::vector<double> weights = full.scene_weights();
    double share = 0.0;
    for (const int s : some) share += weights[static_cast<std::size_t>(s)];
    share /= std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto narrowed = [&](Objective objective) {
      if (!(objective.over == Aggregate::Worst)) objective.over.level = std::max(0.0, 1.0 - (1.0 - objective.over.level) / share);
      return objective;
    };
    std::vector<ObjectiveBound> bounds = full.task().objective_bounds;
    for (ObjectiveBound& bound : bounds) bound.objective = narrowed(bound.objective);
    return full.over_scenes(some).judged_by(narrowed(full.task().combined_objective()), std::move(bounds));
  }

  std::size_t searched() const { return draws_.size(); }
  bool is_spent() const { return used_ >= options_.max_evaluations || clock_.seconds() >= options_.max_seconds; }

 private:
  double judge(DesignProblem& full, const Eigen::VectorXd& x) {
    const int before = full.analyses();
    const double value = full.objective(full.analyse(x, false));
    books_.cycles += std::int64_t{full.analyses() - before} * full.scenes();
    used_ += full.analyses() - before;
    return value;
  }

  /// Adds the draws that decide at x; whether there were new ones among those the statistics hang on.
  bool grow(DesignProblem& full, const Eigen::VectorXd& x) {
    const DesignAnalysis& analysis = full.analyse(x, false);
    std::vector<Objective> objectives{full.task().combined_objective()};
    for (const ObjectiveBound& bound : full.task().objective_bounds) objectives.push_back(bound.objective);
    bool rises = false;
    for (const Objective& objective : objectives) {
      const std::vector<double> measures = measures_of(full, objective, analysis);
      const auto count = is_of_tail(objective.over) ? tail(objective.over, measures.size()) : measures.size();
      std::vector<int> order(measures.size());
      std::iota(order.begin(), order.end(), 0);
      std::ranges::stable_sort(order, [&](int a, int b) { return measures[static_cast<std::size_t>(a)] > measures[static_cast<std::size_t>(b)]; });
      const std::vector<double> weights = aggregate_weights(objective.over, measures, full.scene_weights());
      // Draws beyond a quantile have no weight, yet belong to those that the search has to know.
      std::size_t deciding = 0;
      for (std::size_t i = 0; i < order.size(); ++i) {
        if (weights[static_cast<std::size_t>(order[i])] != 0.0) deciding = i + 1;
      }
      for (std::size_t i = 0; i < std::max(count, deciding); ++i) {
        const bool is_new = draws_.insert(order[i]).second;
        rises = rises || (is_new && i < deciding);
      }
    }
    return rises;
  }

  static std::size_t tail(const Aggregation& over, std::size_t draws) {
    if (over == Aggregate::Worst) return std::min(draws, least_tail);
    const double wanted = std::ceil(tail_width * (1.0 - over.level) * static_cast<double>(draws));
    return std::min(draws, std::max(least_tail, static_cast<std::size_t>(wanted)));
  }

  SolverOptions left() const {
    SolverOptions options = options_;
    options.max_evaluations = std::max(1, options.max_evaluations - used_);
    options.max_seconds = std::max(1e-3, options.max_seconds - clock_.seconds());
    options.progress = nullptr;
    return options;
  }

  Eigen::VectorXd by_epigraph(DesignProblem& part) {
    const LocalRun run = run_local(part, left());
    take(run.status, run.message);
    return run.x;
  }

  Eigen::VectorXd by_gradient(DesignProblem& part) {
    DesignLog log(nullptr);
    DirectProgram program(part, log);
    SolverOptions options = left();
    options.name = "nlopt:slsqp";
    options.max_evaluations = std::min(options.max_evaluations, most_mean_analyses);
    options.tolerance = settled;
    const SolverResult solved = solve(program, options);
    // The limit of one turn is no early end: turns go on as long as they gain.
    const bool turn_ended = solved.status == SolverStatus::EvaluationLimit && options.max_evaluations == most_mean_analyses;
    take(turn_ended ? SolverStatus::Stalled : solved.status, solved.message);
    return log.best() == nullptr ? part.start() : log.best()->x;
  }

  void take(SolverStatus status, const std::string& message) {
    books_.status = status;
    books_.message = message;
  }

  const SolverOptions& options_;
  ScatterDesign& books_;
  const Stopwatch clock_;
  std::set<int> draws_;
  int used_{0};
};

}  // namespace

ScatterDesign search_over_draws(const DesignTask& task, const std::vector<double>& start, const SolverOptions& options) {
  const Stopwatch clock;
  ScatterDesign design;
  DrawSearch search(options, design);
  DesignTask near = task;
  near.leading_share = leading_share;
  DesignProblem full(near);
  design.x = full.scaled_design(start).cwiseMax(0.0).cwiseMin(1.0);
  design.start_value = full.objective(full.analyse(design.x, false));
  if (can_be_coarser(task)) {
    DesignProblem coarse(coarser(near));
    design.x = search.search(coarse, design.x);
  }
  design.x = search.search(full, design.x);
  design.searched = search.searched();
  if (has_steps(task)) {
    design.exact_value = full.objective(full.analyse(design.x, false));
    DesignProblem part = search.reduced(full);
    const RoundedDesign rounded = round_design(part, design.x, std::max(1, most_rounding_cycles / part.scenes()));
    design.cycles += std::int64_t{rounded.analyses} * part.scenes();
    design.x = rounded.x;
  }
  const DesignAnalysis& analysis = full.analyse(design.x, false);
  design.modification = analysis.modification;
  design.value = full.objective(analysis);
  design.violation = full.violation(analysis);
  design.measures = measures_of(full, full.task().combined_objective(), analysis);
  design.weights = aggregate_weights(task.over, design.measures, full.scene_weights());
  for (const ObjectiveBound& bound : task.objective_bounds) design.bounds.push_back(full.value(bound.objective, analysis));
  if (design.violation > DesignLog::tolerance && design.status != SolverStatus::Failed) {
    design.status = SolverStatus::Infeasible;
    design.message = "no design that keeps the constraints over the draws was found";
  }
  design.seconds = clock.seconds();
  return design;
}

}  // namespace flankwright
