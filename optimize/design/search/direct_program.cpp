#include "optimize/design/search/direct_program.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// Rows of a modification constraint: one for each side that it bounds.
int rows_of(const ModificationConstraint& c) { return (c.maximum < no_limit ? 1 : 0) + (c.minimum > -no_limit ? 1 : 0); }

}  // namespace

int DirectProgram::constraints() const {
  const DesignTask& task = problem_.task();
  int rows = static_cast<int>(task.constraints.size() + task.objective_bounds.size());
  for (const ModificationConstraint& c : task.modification_constraints) rows += rows_of(c);
  return rows;
}

Eigen::VectorXd DirectProgram::leading_gradient(const ObjectiveTerm& term, const DesignAnalysis& analysis, int scene) const {
  const LoadedScene there = problem_.scene(analysis, scene);
  const PeakCandidate leader = leading_candidates(term, there, 0.0, 1).front();
  return problem_.scaled(candidate_value(term, leader, there).gradient, analysis, scene);
}

Eigen::VectorXd DirectProgram::aggregate_gradient(const Objective& objective, const DesignAnalysis& analysis) const {
  const std::vector<double> measures = problem_.scene_measures(objective, analysis);
  const std::vector<double> slope = aggregate_weights(objective.over, measures, problem_.scene_weights());
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(variables());
  for (int s = 0; s < problem_.scenes(); ++s) {
    const double share = slope[static_cast<std::size_t>(s)];
    if (share == 0.0) continue;
    for (const ObjectiveTerm& term : objective.terms) {
      gradient += share * term.weight * term.outside_factor() * leading_gradient(term, analysis, s);
    }
  }
  return gradient;
}

Eigen::VectorXd DirectProgram::objective_gradient(const DesignAnalysis& analysis) const {
  const DesignTask& task = problem_.task();
  if (task.scalarisation.empty()) return aggregate_gradient(task.combined_objective(), analysis);
  const auto value = [&](const ScalarisedObjective& scalarised) { return problem_.value(scalarised.objective, analysis); };
  const auto largest =
      std::max_element(task.scalarisation.begin(), task.scalarisation.end(),
                       [&](const ScalarisedObjective& a, const ScalarisedObjective& b) { return a.part(value(a)) < b.part(value(b)); });
  return aggregate_gradient(largest->objective, analysis) / largest->range_at(value(*largest));
}

ProgramValues DirectProgram::evaluate(const Eigen::VectorXd& x, bool with_gradients) {
  const DesignAnalysis& analysis = problem_.analyse(x, with_gradients);
  log_.record(problem_, x, analysis);
  const DesignTask& task = problem_.task();
  ProgramValues values;
  const double objective = problem_.objective(analysis), growth = task.scalarisation.empty() ? task.combined_objective().growth() : 1.0;
  values.objective = std::pow(objective, 1.0 / growth);
  if (with_gradients) {
    const double by_objective = objective > 0.0 ? values.objective / (growth * objective) : 1.0;
    values.objective_gradient = by_objective * objective_gradient(analysis);
  }
  values.constraints.resize(constraints());
  values.constraint_jacobian = Eigen::MatrixXd::Zero(with_gradients ? constraints() : 0, with_gradients ? variables() : 0);
  int row = 0;
  const auto add = [&](double value, const auto& gradient_of) {
    values.constraints[row] = value;
    if (with_gradients) values.constraint_jacobian.row(row) = gradient_of();
    ++row;
  };
  for (const OutputConstraint& bound : task.constraints) {
    const double extreme = problem_.constraint_value(analysis, bound);
    add(bound.excess(extreme), [&] {
      int scene = 0;
      while (output_value(bound.output, problem_.scene(analysis, scene)) != extreme) ++scene;
      const double sign = bound.is_least() ? -1.0 : 1.0;
      return Eigen::VectorXd(sign / std::abs(bound.limit()) * leading_gradient(bound.output, analysis, scene));
    });
  }
  for (const ObjectiveBound& bound : task.objective_bounds) {
    add(problem_.value(bound.objective, analysis) / bound.limit - 1.0,
        [&] { return Eigen::VectorXd(aggregate_gradient(bound.objective, analysis) / bound.limit); });
  }
  for (const ModificationConstraint& c : task.modification_constraints) {
    const double sum = c.value(analysis.modification), scale = problem_.modification_scale(c);
    const auto slope = [&](double sign) { return Eigen::VectorXd(sign / scale * problem_.modification_slope(c)); };
    if (c.maximum < no_limit) add((sum - c.maximum) / scale, [&] { return slope(1.0); });
    if (c.minimum > -no_limit) add((c.minimum - sum) / scale, [&] { return slope(-1.0); });
  }
  return values;
}

}  // namespace flankwright
