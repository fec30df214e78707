#include "optimize/assessment/optimum.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "optimize/design/search/local_model.hpp"

namespace flankwright {

namespace {

using Kind = EpigraphRow::Kind;

/// Multipliers of one kind of row, those of one index together.
std::map<int, double> multipliers_of(const Optimality& optimality, Kind kind) {
  std::map<int, double> sums;
  for (const ActiveBound& felt : optimality.active) {
    if (felt.variable < 0 && felt.row.kind == kind && felt.row.index >= 0) sums[felt.row.index] += felt.multiplier;
  }
  return sums;
}

/// Weights of the scenes in what is minimised: the multipliers of its candidates, less those that bound it from above.
std::vector<Optimum::Scene> scenes_of(const Optimality& optimality) {
  std::map<int, double> weights;
  for (const ActiveBound& felt : optimality.active) {
    const bool of_objective = felt.variable < 0 && felt.row.objective == 0 && felt.row.scene >= 0;
    if (!of_objective || (felt.row.kind != Kind::Floor && felt.row.kind != Kind::Ceiling)) continue;
    weights[felt.row.scene] += felt.row.kind == Kind::Floor ? felt.multiplier : -felt.multiplier;
  }
  std::vector<Optimum::Scene> scenes;
  for (const auto& [scene, weight] : weights) scenes.push_back({scene, weight});
  return scenes;
}

/// Every variable at a bound, and the gain of a step outwards by its multiplier.
std::vector<Optimum::Bound> bounds_of(const DesignTask& task, const Optimality& optimality, const std::vector<double>& values) {
  std::vector<Optimum::Bound> bounds;
  for (std::size_t i = 0; i < task.variables.size(); ++i) {
    const DesignVariable& v = task.variables[i];
    const double range = v.upper - v.lower, step = assessment_step(v.unit()) / v.outside_factor();
    for (const bool upper : {false, true}) {
      double multiplier = 0.0;
      for (const ActiveBound& felt : optimality.active) {
        if (felt.variable == static_cast<int>(i) && (felt.side > 0) == upper) multiplier += felt.multiplier;
      }
      const double slack = std::abs(values[i] - (upper ? v.upper : v.lower)) / range;
      if (multiplier == 0.0 && slack > Optimum::at_bound) continue;
      bounds.push_back({static_cast<int>(i), upper, -optimality.objective_scale * multiplier * step / range});
    }
  }
  return bounds;
}

std::vector<Optimum::Sum> sums_of(const DesignProblem& problem, const Optimality& optimality) {
  std::vector<Optimum::Sum> sums;
  for (const ActiveBound& felt : optimality.active) {
    if (felt.variable >= 0 || felt.row.kind != Kind::ModificationBound) continue;
    const ModificationConstraint& bound = problem.task().modification_constraints[static_cast<std::size_t>(felt.row.index)];
    const double step = assessment_step(bound.unit()) / bound.outside_factor() / problem.modification_scale(bound);
    sums.push_back({felt.row.index, felt.row.side > 0, -optimality.objective_scale * felt.multiplier * step});
  }
  return sums;
}

}  // namespace

Optimum find_optimum(const DesignProblem& problem, const Optimality& optimality, const std::vector<double>& values) {
  const DesignTask& task = problem.task();
  const double scale = optimality.objective_scale;
  constexpr double per_cent = 0.01;
  Optimum optimum;
  optimum.residual = optimality.residual;
  optimum.resolution = std::max(optimality.residual, Optimum::asked) * scale;
  optimum.scenes = scenes_of(optimality);
  optimum.bounds = bounds_of(task, optimality, values);
  optimum.sums = sums_of(problem, optimality);
  for (const auto& [index, multiplier] : multipliers_of(optimality, Kind::OutputBound)) {
    optimum.constraints.push_back({index, -per_cent * scale * multiplier});
  }
  for (const auto& [index, multiplier] : multipliers_of(optimality, Kind::ObjectiveBound)) {
    optimum.objectives.push_back({index, -per_cent * scale * multiplier});
  }
  std::stable_sort(optimum.scenes.begin(), optimum.scenes.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
  const auto by_gain = [](const auto& a, const auto& b) { return a.gain < b.gain; };
  std::stable_sort(optimum.bounds.begin(), optimum.bounds.end(), by_gain);
  std::stable_sort(optimum.constraints.begin(), optimum.constraints.end(), by_gain);
  std::stable_sort(optimum.sums.begin(), optimum.sums.end(), by_gain);
  std::stable_sort(optimum.objectives.begin(), optimum.objectives.end(), by_gain);
  return optimum;
}

}  // namespace flankwright
