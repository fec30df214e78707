#include "optimize/design/more_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "optimize/design/outputs/design_output.hpp"

namespace flankwright {

namespace {

/// What brings a load case near to deciding, relative to the worst objective or to a limit [-].
constexpr double margin = 2.0 * change_by_intervals;

/// The load cases that may decide, rising; all of them where the objective is no worst case, or a sum over a spectrum is bounded. The load cases of
/// a spectrum have the same measure.
std::vector<int> deciding(const DesignProblem& problem, const DesignReport& report) {
  const DesignTask& task = problem.task();
  std::set<int> scenes;
  const auto is_sum = [](const OutputConstraint& constraint) { return design_output(constraint.output.output).over_spectrum; };
  const bool all = task.over != Aggregate::Worst || std::ranges::any_of(task.constraints, is_sum);
  const double near = margin * task.combined_objective().growth();
  const double worst = std::ranges::max(report.scene_measures);
  for (int s = 0; s < problem.scenes(); ++s) {
    if (all || report.scene_measures[static_cast<std::size_t>(s)] >= worst - near * std::abs(worst)) scenes.insert(s);
  }
  for (const OutputConstraint& constraint : task.constraints) {
    double largest = -INFINITY;
    std::vector<std::pair<int, double>> excesses;
    for (const int s : problem.judged_scenes(constraint.output)) {
      excesses.emplace_back(s, constraint.excess(output_value(constraint.output, problem.scene(report.analysis, s))));
      largest = std::max(largest, excesses.back().second);
    }
    for (const auto& [s, excess] : excesses) {
      if (excess >= std::max(largest, 0.0) - margin) scenes.insert(s);
    }
  }
  return {scenes.begin(), scenes.end()};
}

/// Of constraints on damage in parts of what they may change by.
double largest_excess(const DesignTask& task, const DesignReport& report) {
  double excess = -INFINITY;
  for (std::size_t c = 0; c < task.constraints.size(); ++c) {
    const OutputConstraint& constraint = task.constraints[c];
    excess = std::max(excess, constraint.excess(report.constraint_values[c]) / design_output(constraint.output.output).growth);
  }
  return excess;
}

/// How far load cases that are worst in a report, to within `balance`, fall behind another where they are seen more finely, relative to the worst there [-]. The one
/// that falls most counts: a search balances its worst load cases, and where one of them turns out smaller, the others can be traded for it. 0 where the objective is
/// no worst case.
/// @param scenes  of `seen`, as the report numbers them
double lead_lost(const DesignTask& task, const DesignReport& report, const DesignReport& seen, const std::vector<int>& scenes) {
  if (task.over != Aggregate::Worst) return 0.0;
  constexpr double balance = 1e-3;  // two load cases are as bad as each other; a search that ends on a kink balances them to 1e-4 and less
  const double worst = std::ranges::max(report.scene_measures), worst_seen = std::ranges::max(seen.scene_measures);
  double lost = 0.0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const bool is_worst = report.scene_measures[static_cast<std::size_t>(scenes[i])] >= worst - balance * std::abs(worst);
    if (is_worst && worst_seen > 0.0) lost = std::max(lost, 1.0 - seen.scene_measures[i] / worst_seen);
  }
  return lost;
}

/// FinerLook::excess_changes.
std::vector<double> excess_changes(const DesignTask& task, const DesignReport& report, const DesignReport& seen) {
  std::vector<double> changes;
  for (std::size_t c = 0; c < task.constraints.size(); ++c) {
    const double excess = task.constraints[c].excess(report.constraint_values[c]);
    changes.push_back(excess < -margin ? 0.0 : four_times_by_twice * (task.constraints[c].excess(seen.constraint_values[c]) - excess));
  }
  return changes;
}

}  // namespace

bool is_turned(const DesignTask& task, const DesignReport& report, const DesignReport& seen, const std::vector<int>& scenes, bool infeasible,
               double change) {
  const double excess = largest_excess(task, report), seen_excess = largest_excess(task, seen);
  if (infeasible) return std::abs(seen_excess - excess) > change * (1.0 + excess);
  const double growth = task.combined_objective().growth();
  return seen_excess > std::max(excess, 0.0) + 0.5 * change ||
         std::abs(seen.objective - report.objective) > change * growth * std::abs(report.objective) ||
         lead_lost(task, report, seen, scenes) > change * growth;
}

FinerLook look_finer(const DesignProblem& problem, const DesignReport& report, bool infeasible) {
  const DesignTask& task_of_search = problem.task();
  const std::vector<int> scenes = deciding(problem, report);
  DesignTask task = task_of_search;
  task.scenes.clear();
  for (const int s : scenes) task.scenes.push_back(task_of_search.scenes[static_cast<std::size_t>(s)]);
  task.resolution.quadrature.intervals *= 2;
  const DesignProblem finer(std::move(task));
  const DesignReport seen = report_design(finer, finer.analyse_design(report.analysis.modification));
  if (!seen.analysis.usable()) return {};
  return {.needs_more = is_turned(task_of_search, report, seen, scenes, infeasible, change_by_doubling),
          .excess_changes = excess_changes(task_of_search, report, seen)};
}

}  // namespace flankwright
