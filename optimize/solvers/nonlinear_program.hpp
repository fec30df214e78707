#pragma once

#include <Eigen/Core>
#include <limits>

namespace flankwright {

/// Values at one point of a nonlinear programme. Gradients are filled only on request.
struct ProgramValues {
  double objective{std::numeric_limits<double>::quiet_NaN()};
  Eigen::VectorXd objective_gradient;   ///< n
  Eigen::VectorXd constraints;          ///< m, feasible where <= 0
  Eigen::MatrixXd constraint_jacobian;  ///< m x n
};

/// minimise f(x)  subject to  c(x) <= 0,  lower <= x <= upper.
///
/// One interface for every solver: solve() of optimize/solvers/solver.hpp takes it. Variables are expected to be scaled so that
/// their ranges are of order one. Evaluation must be deterministic. Any number of programmes may be solved at the same
/// time in different threads.
class NonlinearProgram {
 public:
  virtual ~NonlinearProgram() = default;

  virtual int variables() const = 0;    ///< n >= 1
  virtual int constraints() const = 0;  ///< m >= 0
  /// n lower bounds; minus infinity where there is none (the global solvers need finite bounds). Equal bounds fix a
  /// variable.
  virtual Eigen::VectorXd lower() const = 0;
  virtual Eigen::VectorXd upper() const = 0;  ///< n upper bounds, >= lower(); plus infinity where there is none
  virtual Eigen::VectorXd start() const = 0;  ///< inside the bounds

  /// Values at x. May throw: the adapters survive it, count it as a failed evaluation and treat the point as unusable;
  /// so they do with a value that is not finite or an array of the wrong size.
  /// @param with_gradients  false from derivative-free solvers: the gradients need not be computed then
  virtual ProgramValues evaluate(const Eigen::VectorXd& x, bool with_gradients) = 0;
};

}  // namespace flankwright
