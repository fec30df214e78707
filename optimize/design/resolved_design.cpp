#include "optimize/design/resolved_design.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/design/aggregate.hpp"
#include "optimize/design/scene_outputs.hpp"

namespace flankwright {

namespace {

struct Measures {
  std::vector<double> values, errors;  ///< per scene, outside units
};

ResolvedValue value_in(const ObjectiveTerm& term, const DesignProblem& problem, const DesignReport& report, const std::vector<ResolvedCycle>& cycles,
                       int scene) {
  const auto s = static_cast<std::size_t>(scene);
  return resolved_value(term, problem.scene(report.analysis, scene), cycles[s]);
}

Measures measures_of(const Objective& minimised, const DesignProblem& problem, const DesignReport& report, const std::vector<ResolvedCycle>& cycles) {
  Measures measures;
  if (minimised.over_spectrum()) {  // sums of the positions' own stresses; no error is estimated
    measures.values = problem.scene_measures(minimised, report.analysis);
    measures.errors.assign(measures.values.size(), not_given);
    return measures;
  }
  for (int s = 0; s < problem.scenes(); ++s) {
    double value = 0.0, error = 0.0;
    for (const ObjectiveTerm& term : minimised.terms) {
      const ResolvedValue resolved = value_in(term, problem, report, cycles, s);
      const double factor = term.weight * term.outside_factor();
      value += factor * resolved.value;
      error += std::abs(factor) * resolved.error;
    }
    measures.values.push_back(value);
    measures.errors.push_back(error);
  }
  return measures;
}

double combined(const Objective& minimised, const Measures& measures, double shift, const std::vector<double>& weights) {
  std::vector<double> shifted = measures.values;
  for (std::size_t s = 0; s < shifted.size(); ++s) shifted[s] = std::max(0.0, shifted[s] + shift * measures.errors[s]);
  return aggregate(minimised.over, shifted, weights);
}

ResolvedValue value_of(const Objective& minimised, const Measures& measures, const std::vector<double>& weights) {
  const double value = aggregate(minimised.over, measures.values, weights);
  if (std::ranges::any_of(measures.errors, [](double e) { return std::isnan(e); })) return {value, not_given};
  return {value,
          std::max(std::abs(combined(minimised, measures, 1.0, weights) - value), std::abs(combined(minimised, measures, -1.0, weights) - value))};
}

}  // namespace

DesignErrors resolve_report(const DesignProblem& problem, const std::vector<ResolvedCycle>& cycles, DesignReport& report) {
  const DesignTask& task = problem.task();
  const std::vector<double> weights = problem.scene_weights();
  DesignErrors errors;
  Measures measures = measures_of(task.combined_objective(), problem, report, cycles);
  const ResolvedValue objective = value_of(task.combined_objective(), measures, weights);
  report.objective = objective.value;
  errors.objective = objective.error;
  report.scene_measures = std::move(measures.values);
  errors.scene_measures = std::move(measures.errors);
  for (std::size_t c = 0; c < task.constraints.size(); ++c) {
    const OutputConstraint& constraint = task.constraints[c];
    ResolvedValue nearest;
    for (const int s : problem.judged_scenes(constraint.output)) {
      const ResolvedValue here = value_in(constraint.output, problem, report, cycles, s);
      const bool nearer = constraint.is_least() ? here.value < nearest.value : here.value > nearest.value;
      if (nearer || std::isnan(nearest.value)) nearest = here;
    }
    report.constraint_values[c] = nearest.value;
    errors.constraint_values.push_back(nearest.error);
  }
  for (std::size_t k = 0; k < task.later_objectives.size(); ++k) {
    const Objective& minimised = task.later_objectives[k];
    const ResolvedValue later = value_of(minimised, measures_of(minimised, problem, report, cycles), weights);
    report.later_objectives[k] = later.value;
    errors.later_objectives.push_back(later.error);
  }
  return errors;
}

}  // namespace flankwright
