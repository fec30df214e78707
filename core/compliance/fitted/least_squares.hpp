#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace flankwright {

/// How a fit ended.
enum class FitStatus {
  NotRun,
  Converged,       ///< the cost, the step or the gradient fell below its tolerance
  IterationLimit,  ///< usable, but might still improve
  Failed,          ///< the residuals are not finite at the start, or the solver broke down
};

const char* to_string(FitStatus status);

/// Residuals of a non-linear least-squares problem with derivatives.
class ResidualFunction {
 public:
  virtual ~ResidualFunction() = default;
  virtual int residual_count() const = 0;     ///< m
  virtual int coefficient_count() const = 0;  ///< n

  /// @param x          size n
  /// @param residuals  overwritten, size m
  /// @param jacobian   overwritten, m x n row by row; empty where it is not wanted
  /// @return false where the residuals are not defined or not finite at x: the solver then shortens its step
  virtual bool evaluate(std::span<const double> x, std::span<double> residuals, std::span<double> jacobian) const = 0;
};

struct LeastSquaresOptions {
  /// Trust-region steps before giving up, >= 1.
  int max_iterations{100};
  /// Converged when a step changes the cost by less than cost_tolerance times the cost [-], > 0.
  double cost_tolerance{1e-6};
  /// Throws InvalidInput with field, value and violated bound.
  void validate() const;
};

struct LeastSquaresResult {
  FitStatus status{FitStatus::NotRun};
  std::string message{"solve_least_squares() was not called"};
  std::vector<double> coefficients;                               ///< the best found; the start where it failed at once
  double initial_cost{std::numeric_limits<double>::quiet_NaN()};  ///< half the sum of squares at the start
  double cost{std::numeric_limits<double>::quiet_NaN()};          ///< half the sum of squares at the end
  int iterations{-1};                                             ///< trust-region steps tried; -1: never ran
};

/// Minimises half the sum of squares by Levenberg and Marquardt's method (Ceres, normal equations by Cholesky). One
/// thread and Eigen's own kernels throughout: the same input gives the same bits.
/// @throws InvalidInput where the start has the wrong size or an option is out of range
LeastSquaresResult solve_least_squares(const ResidualFunction& function, std::span<const double> start, const LeastSquaresOptions& options);

}  // namespace flankwright
