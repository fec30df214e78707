#include "optimize/design/more_intervals.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "optimize/design/design_output.hpp"
#include "optimize/design/task_checks.hpp"

namespace flankwright {

namespace {

/// The load cases that may decide, rising; all of them where the objective is no worst case, or is a sum over a spectrum.
std::vector<int> deciding(const DesignProblem& problem, const DesignReport& report) {
  constexpr double margin = 2.0 * change_by_intervals;
  const DesignTask& task = problem.task();
  std::set<int> scenes;
  const auto over_spectrum = [](const ObjectiveTerm& term) { return design_output(term.output).over_spectrum; };
  const bool all = task.over != Aggregate::Worst || std::ranges::any_of(terms_of(task), over_spectrum);
  const double worst = std::ranges::max(report.scene_measures);
  for (int s = 0; s < problem.scenes(); ++s) {
    if (all || report.scene_measures[static_cast<std::size_t>(s)] >= worst - margin * std::abs(worst)) scenes.insert(s);
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

double largest_excess(const DesignTask& task, const DesignReport& report) {
  double excess = -INFINITY;
  for (std::size_t c = 0; c < task.constraints.size(); ++c) excess = std::max(excess, task.constraints[c].excess(report.constraint_values[c]));
  return excess;
}

}  // namespace

bool needs_more_intervals(const DesignProblem& problem, const DesignReport& report, bool infeasible) {
  const std::vector<int> scenes = deciding(problem, report);
  DesignTask task = problem.task();
  task.scenes.clear();
  for (const int s : scenes) task.scenes.push_back(problem.task().scenes[static_cast<std::size_t>(s)]);
  task.resolution.quadrature.intervals *= 2;
  const DesignProblem finer(std::move(task));
  const DesignReport seen = report_design(finer, finer.analyse_design(report.analysis.modification));
  if (!std::ranges::all_of(seen.analysis.cycles, [](const LoadedCycle& cycle) { return cycle.usable(); })) return false;
  const double excess = largest_excess(problem.task(), report), seen_excess = largest_excess(problem.task(), seen);
  if (infeasible) return std::abs(seen_excess - excess) > change_by_intervals * (1.0 + excess);
  if (seen_excess > std::max(excess, 0.0) + 0.5 * change_by_intervals) return true;
  return std::abs(seen.objective - report.objective) > change_by_intervals * std::abs(report.objective);
}

}  // namespace flankwright
