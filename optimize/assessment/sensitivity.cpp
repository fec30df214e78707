#include "optimize/assessment/sensitivity.hpp"

#include <Eigen/QR>
#include <utility>

#include "optimize/assessment/optimum.hpp"

namespace flankwright {

namespace {

/// What has a multiplier, with the candidates of another mesh at the same positions.
std::vector<ActiveBound> counterparts(std::vector<ActiveBound> active, const DesignProblem& problem, const PerGear<Modification>& design) {
  const DesignAnalysis analysis = problem.analyse_design(design);
  for (ActiveBound& felt : active) {
    if (felt.by_output == 0.0) continue;  // no row of an output
    felt.row.candidate = counterpart(term_of(felt.row, problem.task()), felt.row.candidate, problem.scene(analysis, felt.row.scene));
  }
  return active;
}

/// Of one parameter of a local model.
Sensitivity sensitivity_of(const DesignProblem& problem, const LocalModel& model, const AssessedParameter& parameter, Eigen::Index p) {
  Sensitivity found{.parameter = parameter, .intervals = problem.task().resolution.quadrature.intervals};
  const Eigen::VectorXd step = Eigen::VectorXd::Unit(model.parameters(), p);
  const double now = model.objective(Eigen::VectorXd::Zero(model.parameters()));
  found.less = model.objective(-step) - now;
  found.more = model.objective(step) - now;
  return found;
}

void add_variables(const DesignProblem& problem, const LocalModel& model, const std::vector<double>& values,
                   std::vector<Sensitivity>& sensitivities) {
  const std::vector<AssessedParameter> parameters = variable_parameters(problem.task());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    Sensitivity found = sensitivity_of(problem, model, parameters[i], static_cast<Eigen::Index>(i));
    const DesignVariable& v = problem.task().variables[i];
    const double slack = Optimum::at_bound * (v.upper - v.lower);
    found.can_less = values[i] - found.parameter.inside >= v.lower - slack;
    found.can_more = values[i] + found.parameter.inside <= v.upper + slack;
    sensitivities.push_back(std::move(found));
  }
}

/// @param model  of assessed_parameters()
void add_tolerances(const DesignProblem& problem, const LocalModel& model, const Eigen::VectorXd& lagrangian,
                    std::vector<Sensitivity>& sensitivities) {
  const std::vector<AssessedParameter> parameters = assessed_parameters(problem.task());
  for (std::size_t p = problem.task().variables.size(); p < parameters.size(); ++p) {
    const auto column = static_cast<Eigen::Index>(p);
    sensitivities.push_back(sensitivity_of(problem, model, parameters[p], column));
    sensitivities.back().optimised_anew = lagrangian[column];
  }
}

}  // namespace

std::vector<Sensitivity> find_sensitivities(const DesignProblem& problem, const Optimality& optimality, const PerGear<Modification>& design,
                                            const std::vector<double>& values, int most_tolerance_intervals) {
  const std::vector<ActiveBound>& active = optimality.active;
  std::vector<Sensitivity> found;
  if (problem.task().resolution.quadrature.intervals <= most_tolerance_intervals) {
    const LocalModel model(problem, design, assessed_parameters(problem.task()), active);
    add_variables(problem, model, values, found);
    add_tolerances(problem, model, optimality.objective_scale * model.lagrangian_slope(), found);
    return found;
  }
  const LocalModel model(problem, design, variable_parameters(problem.task()), active);
  add_variables(problem, model, values, found);
  DesignTask task = problem.task();
  task.resolution.quadrature.intervals = most_tolerance_intervals;
  const DesignProblem coarser(std::move(task));
  const LocalModel coarse(coarser, design, assessed_parameters(problem.task()), counterparts(active, coarser, design));
  const Eigen::MatrixXd by_variables = coarse.active_slopes().leftCols(problem.variables()).transpose();
  const Eigen::VectorXd unbalanced = model.lagrangian_slope() - coarse.lagrangian_slope().head(problem.variables());
  const Eigen::VectorXd correction = by_variables.completeOrthogonalDecomposition().solve(unbalanced);
  add_tolerances(coarser, coarse, optimality.objective_scale * (coarse.lagrangian_slope() + coarse.active_slopes().transpose() * correction), found);
  return found;
}

}  // namespace flankwright
