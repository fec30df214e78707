#include "optimize/design/resolved_design.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/design/outputs/aggregate.hpp"
#include "optimize/design/outputs/scene_outputs.hpp"

namespace flankwright {

namespace {

struct Measures {
  std::vector<double> values, errors;  ///< per scene, outside units
};

/// An analysis with its resolved cycles.
struct Resolving {
  const DesignProblem& problem;
  const DesignAnalysis& analysis;
  const std::vector<ResolvedCycle>& cycles;
  const FurtherError& further_error;

  double further(const ObjectiveTerm& term, int scene) const { return further_error ? further_error(term, scene) : not_given; }

  ResolvedValue value_in(const ObjectiveTerm& term, int scene) const {
    ResolvedValue value = resolved_value(term, problem.scene(analysis, scene), cycles[static_cast<std::size_t>(scene)]);
    if (std::isnan(value.error)) value.error = further(term, scene);
    return value;
  }

  Measures measures_of(const Objective& minimised) const {
    Measures measures;
    const bool over_spectrum = minimised.over_spectrum();  // sums over load cases, of the positions' own stresses
    if (over_spectrum) measures.values = problem.scene_measures(minimised, analysis);
    for (int s = 0; s < problem.scenes(); ++s) {
      double value = 0.0, error = 0.0;
      for (const ObjectiveTerm& term : minimised.terms) {
        const double factor = term.weight * term.outside_factor();
        const ResolvedValue resolved = over_spectrum ? ResolvedValue{not_given, further(term, s)} : value_in(term, s);
        value += factor * resolved.value;
        error += std::abs(factor) * resolved.error;
      }
      if (!over_spectrum) measures.values.push_back(value);
      measures.errors.push_back(error);
    }
    return measures;
  }
};

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

DesignErrors resolve_report(const DesignProblem& problem, const std::vector<ResolvedCycle>& cycles, DesignReport& report,
                            const FurtherError& further_error) {
  const DesignTask& task = problem.task();
  const std::vector<double> weights = problem.scene_weights();
  const Resolving resolving{problem, report.analysis, cycles, further_error};
  DesignErrors errors;
  Measures measures = resolving.measures_of(task.combined_objective());
  const ResolvedValue objective = value_of(task.combined_objective(), measures, weights);
  report.objective = objective.value;
  errors.objective = objective.error;
  report.scene_measures = std::move(measures.values);
  errors.scene_measures = std::move(measures.errors);
  for (std::size_t c = 0; c < task.constraints.size(); ++c) {
    const OutputConstraint& constraint = task.constraints[c];
    ResolvedValue nearest;
    for (const int s : problem.judged_scenes(constraint.output)) {
      const ResolvedValue here = resolving.value_in(constraint.output, s);
      const bool nearer = constraint.is_least() ? here.value < nearest.value : here.value > nearest.value;
      if (nearer || std::isnan(nearest.value)) nearest = here;
    }
    report.constraint_values[c] = nearest.value;
    errors.constraint_values.push_back(nearest.error);
  }
  for (std::size_t k = 0; k < task.later_objectives.size(); ++k) {
    const Objective& minimised = task.later_objectives[k];
    const ResolvedValue later = value_of(minimised, resolving.measures_of(minimised), weights);
    report.later_objectives[k] = later.value;
    errors.later_objectives.push_back(later.error);
  }
  return errors;
}

std::vector<ResolvedValue> resolved_values(const DesignProblem& problem, const std::vector<Objective>& objectives, const DesignAnalysis& analysis,
                                           const std::vector<ResolvedCycle>& cycles, const FurtherError& further_error) {
  const std::vector<double> weights = problem.scene_weights();
  const Resolving resolving{problem, analysis, cycles, further_error};
  std::vector<ResolvedValue> values;
  for (const Objective& objective : objectives) values.push_back(value_of(objective, resolving.measures_of(objective), weights));
  return values;
}

}  // namespace flankwright
