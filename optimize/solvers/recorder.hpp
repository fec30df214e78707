#pragma once

#include <Eigen/Core>
#include <chrono>
#include <deque>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

#include "optimize/solvers/nonlinear_program.hpp"
#include "optimize/solvers/solver_options.hpp"

namespace flankwright {

/// Thrown by Recorder::at() to end a run in order; an adapter lets it (or its library's like) reach its own run
/// function.
struct StopRun {};

/// The result of an adapter: status and point at which its library ended.
struct SolverEnding {
  SolverStatus status{SolverStatus::NotRun};
  std::string message;
  Eigen::VectorXd x;            ///< the library's final point; empty where it gave none
  Eigen::VectorXd multipliers;  ///< of c(x) <= 0 at x; empty where it gave none
};

/// Connects a programme to a solver library: evaluates each point once, records the run and the best point, and ends
/// the run at its limits.
///
/// Libraries ask for objective, gradient, constraints and Jacobian separately; all four come from one evaluate(). The
/// values of every point are kept for the whole run, the gradients of the last 64 points only (a dense Jacobian is
/// large): a library that asks for the gradient at an older point causes, and is charged, a second evaluation there.
class Recorder {
 public:
  struct Point {
    bool usable{false};                                          ///< evaluated without failure
    double violation{std::numeric_limits<double>::quiet_NaN()};  ///< max(0, max c_i)
    ProgramValues values;                                        ///< NaN and empty where not usable
  };

  /// @param with_gradients  the solver uses gradients: every evaluation computes them
  Recorder(NonlinearProgram& program, const SolverOptions& options, bool with_gradients);

  /// The point at x clipped to the bounds, evaluated unless it is known. The reference stays valid, its gradients until
  /// 64 further evaluations. Throws StopRun at a limit, when x is not finite, when the library only asks for known
  /// points, or when the progress callback threw; and ever after.
  const Point& at(const Eigen::VectorXd& x, bool gradients_needed);

  const NonlinearProgram& program() const { return program_; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  const Eigen::VectorXd& start() const { return start_; }    ///< inside the bounds
  const Eigen::VectorXd& best_x() const { return best_x_; }  ///< best point so far; empty before the first usable one
  double best_objective() const { return best_objective_; }  ///< NaN before the first usable point
  bool best_is_feasible() const { return feasible(best_violation_); }
  /// Why at() threw StopRun; status NotRun before it did.
  const SolverEnding& stop_reason() const { return stop_reason_; }

  /// The result of the run: the library's ending checked against what was recorded.
  SolverResult result(SolverEnding ending);

 private:
  [[noreturn]] void stop(SolverStatus status, const std::string& message);
  Point evaluate(const Eigen::VectorXd& x);
  void keep_if_best(const Eigen::VectorXd& x, const Point& point);
  void keep_gradients_of(Point& point);
  bool feasible(double violation) const { return violation <= options_.constraint_tolerance; }
  double seconds() const;

  NonlinearProgram& program_;
  const SolverOptions& options_;
  const bool with_gradients_;
  const std::chrono::steady_clock::time_point begin_;
  Eigen::VectorXd lower_, upper_, start_;

  std::unordered_map<std::string, Point> points_;  ///< keyed by the bytes of x
  std::deque<Point*> with_kept_gradients_;
  std::vector<SolverStep> history_;
  int evaluations_{0}, gradient_evaluations_{0}, failures_{0}, known_in_a_row_{0};
  std::string first_failure_;
  SolverEnding stop_reason_;

  Eigen::VectorXd best_x_;  ///< empty before the first usable point
  double best_objective_{std::numeric_limits<double>::quiet_NaN()};
  double best_violation_{std::numeric_limits<double>::infinity()};
};

}  // namespace flankwright
