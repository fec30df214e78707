#include "optimize/design/search/deciding_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>

namespace flankwright {

namespace {

/// What is minimised.
std::vector<Objective> minimised(const DesignTask& task) {
  if (task.scalarisation.empty()) return {task.combined_objective()};
  std::vector<Objective> objectives;
  for (const ScalarisedObjective& scalarised : task.scalarisation) objectives.push_back(scalarised.objective);
  return objectives;
}

}  // namespace

bool single_scenes_decide(const DesignTask& task) {
  const auto is_peak = [](const ObjectiveTerm& term) { return design_output(term.output).at_points != nullptr; };
  const auto of_worst_peaks = [&](const Objective& o) { return o.over == Aggregate::Worst && std::ranges::all_of(o.terms, is_peak); };
  return task.constraints.empty() && task.objective_bounds.empty() && std::ranges::all_of(minimised(task), of_worst_peaks);
}

std::set<int> deciding_scenes(const DesignProblem& problem, const DesignAnalysis& analysis, double near, const std::set<int>& among) {
  std::set<int> found;
  for (const Objective& objective : minimised(problem.task())) {
    const std::vector<double> measures = problem.scene_measures(objective, analysis);
    double largest = -INFINITY;
    for (int s = 0; s < problem.scenes(); ++s) {
      if (among.empty() || among.contains(s)) largest = std::max(largest, measures[static_cast<std::size_t>(s)]);
    }
    for (int s = 0; s < problem.scenes(); ++s) {
      if (measures[static_cast<std::size_t>(s)] >= largest - near * std::abs(largest)) found.insert(s);
    }
  }
  return found;
}

std::set<int> worst_scenes(const DesignProblem& problem, const DesignAnalysis& analysis, int count) {
  const std::vector<double> measures = problem.scene_measures(minimised(problem.task()).front(), analysis);
  std::vector<int> order(measures.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](int s) { return measures[static_cast<std::size_t>(s)]; });
  order.resize(static_cast<std::size_t>(std::min<std::ptrdiff_t>(count, std::ssize(order))));
  return {order.begin(), order.end()};
}

}  // namespace flankwright
