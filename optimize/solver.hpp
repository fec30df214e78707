#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "optimize/nonlinear_program.hpp"

namespace flankwright {

/// How a solver run ended.
enum class SolverStatus { NotRun, Converged, EvaluationLimit, TimeLimit, Stalled, Infeasible, Failed };

/// Lower-case words for a status ("converged", "evaluation limit", ...).
std::string to_string(SolverStatus status);

/// What the engineer's study asks of a solver.
struct SolverOptions {
  /// "ipopt", or "nlopt:NAME" with NAME one of slsqp, mma, ccsaq, lbfgs, cobyla, bobyqa, sbplx, neldermead, crs2_lm, isres,
  /// direct_l, esch, mlsl (see solver_names()).
  std::string name{"ipopt"};
  /// Stop when the scaled step or first-order residual is at most this [-], > 0.
  double tolerance{1e-7};
  /// Evaluations of the programme before an orderly stop with the best point so far, >= 1.
  int max_evaluations{2000};
  /// Seconds before an orderly stop with the best point so far, > 0.
  double max_seconds{std::numeric_limits<double>::infinity()};
  /// Seed of the stochastic solvers.
  unsigned long seed{1};
  /// Called after each evaluation with (evaluations so far, best feasible objective so far); may be empty.
  std::function<void(int, double)> progress;
  /// Throws InvalidInput naming the field, its value and what is allowed.
  void validate() const;
};

/// One evaluation of the history.
struct SolverStep {
  int evaluation{-1};
  double objective{std::numeric_limits<double>::quiet_NaN()};
  double constraint_violation{std::numeric_limits<double>::quiet_NaN()};  ///< max(0, max c_i)
};

/// Outcome of a solver run. Poisoned until the solver wrote it.
struct SolverResult {
  SolverStatus status{SolverStatus::NotRun};
  std::string message{"the solver was not called"};
  std::string solver;                   ///< the name used
  Eigen::VectorXd x;                    ///< best point: feasible with the least objective, else the least violation
  double objective{std::numeric_limits<double>::quiet_NaN()};
  double constraint_violation{std::numeric_limits<double>::quiet_NaN()};
  Eigen::VectorXd multipliers;          ///< of c(x) <= 0, >= 0; empty where the solver gives none
  int evaluations{-1};                  ///< distinct points evaluated
  int gradient_evaluations{-1};         ///< of these, with gradients
  int failures{-1};                     ///< evaluations that threw or gave a value that is not finite
  double seconds{std::numeric_limits<double>::quiet_NaN()};
  std::vector<SolverStep> history;
};

/// Solves a programme with the solver of options.name. Throws InvalidInput for an unknown name or for a solver that cannot
/// take the programme (an unconstrained method with constraints); everything else is a status.
SolverResult solve(NonlinearProgram& program, const SolverOptions& options);

/// True where the solver uses gradients.
bool uses_gradients(const std::string& solver_name);

/// True where the solver accepts c(x) <= 0.
bool accepts_constraints(const std::string& solver_name);

/// All solver names that solve() takes.
std::vector<std::string> solver_names();

}  // namespace flankwright
