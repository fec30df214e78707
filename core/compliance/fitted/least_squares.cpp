#include "core/compliance/fitted/least_squares.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace flankwright {
namespace {

/// The whole problem is one dense block: pairs of points share all coefficients.
class DenseCost final : public ceres::CostFunction {
 public:
  explicit DenseCost(const ResidualFunction& function) : function_(function) {
    set_num_residuals(function.residual_count());
    mutable_parameter_block_sizes()->push_back(function.coefficient_count());
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const auto m = static_cast<std::size_t>(num_residuals());
    const auto n = static_cast<std::size_t>(function_.coefficient_count());
    double* jacobian = jacobians ? jacobians[0] : nullptr;
    return function_.evaluate({parameters[0], n}, {residuals, m}, {jacobian, jacobian ? m * n : 0});
  }

 private:
  const ResidualFunction& function_;
};

bool finite_at(const ResidualFunction& function, std::span<const double> x) {
  const auto m = static_cast<std::size_t>(function.residual_count());
  std::vector<double> residuals(m), jacobian(m * x.size());
  const auto all_finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  return function.evaluate(x, residuals, jacobian) && all_finite(residuals) && all_finite(jacobian);
}

}  // namespace

void LeastSquaresOptions::validate() const {
  if (max_iterations < 1) throw InvalidInput("fit.max_iterations", std::to_string(max_iterations), "at least 1");
  if (!(cost_tolerance > 0)) throw InvalidInput("fit.cost_tolerance", std::to_string(cost_tolerance), "positive");
}

LeastSquaresResult solve_least_squares(const ResidualFunction& function, std::span<const double> start, const LeastSquaresOptions& options) {
  options.validate();
  if (static_cast<int>(start.size()) != function.coefficient_count()) {
    throw InvalidInput("fit.start", std::to_string(start.size()) + " coefficients", std::to_string(function.coefficient_count()));
  }
  LeastSquaresResult result;
  result.coefficients.assign(start.begin(), start.end());

  // Ceres would repeat on stderr what the status says.
  if (!finite_at(function, start)) {
    result.status = FitStatus::Failed;
    result.message = "residuals or their derivatives are not finite at the start";
    result.iterations = 0;
    return result;
  }

  DenseCost cost(function);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, result.coefficients.data());

  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.dense_linear_algebra_library_type = ceres::EIGEN;
  solver.num_threads = 1;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.cost_tolerance;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);

  result.message = summary.message;
  result.initial_cost = summary.initial_cost;
  result.cost = summary.final_cost;
  result.iterations = static_cast<int>(summary.iterations.size()) - 1;
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      result.status = FitStatus::Converged;
      break;
    case ceres::NO_CONVERGENCE:
      result.status = FitStatus::IterationLimit;
      break;
    default:
      result.status = FitStatus::Failed;
  }
  return result;
}

const char* to_string(FitStatus status) {
  switch (status) {
    case FitStatus::NotRun:
      return "not run";
    case FitStatus::Converged:
      return "converged";
    case FitStatus::IterationLimit:
      return "iteration limit";
    case FitStatus::Failed:
      return "failed";
  }
  __builtin_unreachable();
}

}  // namespace flankwright
