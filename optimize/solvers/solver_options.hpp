#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace flankwright {

/// How a solver run ended.
///
/// Converged: the solver's own convergence test was met at a feasible point. EvaluationLimit, TimeLimit: stopped in
/// order. Stalled: no more progress without meeting the test. Infeasible: it ended where no point met so far is
/// feasible. Failed: the start cannot be evaluated, or the library gave up; the message says why.
enum class SolverStatus { NotRun, Converged, EvaluationLimit, TimeLimit, Stalled, Infeasible, Failed };

/// Lower-case words for a status ("converged", "evaluation limit", ...).
std::string to_string(SolverStatus status);

/// The options of a solver that a study can set.
struct SolverOptions {
  /// "ipopt", or "nlopt:NAME" with NAME one of slsqp, mma, ccsaq, lbfgs, cobyla, bobyqa, sbplx, neldermead, crs2_lm,
  /// isres, direct_l, esch, mlsl (see solver_names()).
  std::string name{"ipopt"};
  /// For a design run (run_local()), not for solve(): the solver that continues from the best design where `name`
  /// stalls on a kink, one of finisher_names(). An active-set method steps onto the kink.
  std::string finisher{"nlopt:slsqp"};
  /// Convergence tolerance [-], > 0. Ipopt: scaled first-order residual <= tolerance. NLopt: step of variable i <=
  /// tolerance * (upper_i - lower_i). esch, direct_l and mlsl have no convergence test: they end at a limit.
  double tolerance{1e-7};
  /// A point is feasible where max_i c_i(x) <= constraint_tolerance (unit of the constraints), > 0.
  double constraint_tolerance{1e-6};
  /// Evaluations of the programme before an orderly stop with the best point so far, >= 1.
  int max_evaluations{2000};
  /// Seconds before an orderly stop with the best point so far, > 0. An evaluation under way is finished.
  double max_seconds{std::numeric_limits<double>::infinity()};
  /// Seed of the stochastic solvers: crs2_lm, isres, esch, mlsl.
  unsigned long seed{1};
  /// Called after each evaluation with (evaluations so far, best feasible objective so far: NaN where none); may be
  /// empty. If it throws, the run ends in order (status Failed, best point so far).
  std::function<void(int, double)> progress;
  /// Asked after each evaluation; may be empty. A text that is not empty ends the run in order (status Stalled) and says why.
  std::function<std::string()> stop_when;
  /// Throws InvalidInput naming the field, its value and what is allowed.
  void validate() const;
};

/// One evaluation of the history.
struct SolverStep {
  int evaluation{-1};                                                     ///< 1, 2, 3 ...
  double objective{std::numeric_limits<double>::quiet_NaN()};             ///< NaN where the evaluation failed
  double constraint_violation{std::numeric_limits<double>::quiet_NaN()};  ///< max(0, max c_i)
};

/// Outcome of a solver run. Poisoned until the solver wrote it.
struct SolverResult {
  SolverStatus status{SolverStatus::NotRun};
  std::string message{"the solver was not called"};
  std::string solver;  ///< the name used
  /// Best point met, never outside the bounds: feasible with the least objective, else the least violation. A converged
  /// solver's own last point is preferred where it is feasible and its objective exceeds the least by no more than
  /// 10 * constraint_tolerance * max(1, |least|), which is what a violation inside the tolerance may buy.
  Eigen::VectorXd x;
  double objective{std::numeric_limits<double>::quiet_NaN()};
  double constraint_violation{std::numeric_limits<double>::quiet_NaN()};  ///< max(0, max c_i) at x
  Eigen::VectorXd multipliers;   ///< of c(x) <= 0 at x, >= 0, size m; empty where the solver gives none (all but Ipopt)
  int evaluations{-1};           ///< calls of evaluate(): distinct points, but see Recorder
  int gradient_evaluations{-1};  ///< of these, with gradients
  int failures{-1};              ///< evaluations that threw or gave a value that is not finite
  double seconds{std::numeric_limits<double>::quiet_NaN()};
  std::vector<SolverStep> history;
};

/// Capabilities and requirements of a solver.
struct SolverTraits {
  std::string_view name;
  bool gradients;    ///< uses them
  bool constraints;  ///< accepts c(x) <= 0
  bool global;       ///< searches the whole box: needs finite bounds, survives a start that cannot be evaluated
  int least_free_variables;
};
/// Throws InvalidInput for an unknown name.
const SolverTraits& solver_traits(const std::string& name);
/// The names of solvers for which a condition holds, in words.
std::string solvers_where(const std::function<bool(const SolverTraits&)>& condition);

/// True where the solver uses gradients. Throws InvalidInput for an unknown name.
bool uses_gradients(const std::string& solver_name);

/// True where the solver accepts c(x) <= 0. Throws InvalidInput for an unknown name.
bool accepts_constraints(const std::string& solver_name);

/// All solver names that solve() takes.
std::vector<std::string> solver_names();

/// "none", and the solvers that use gradients and accept constraints.
std::vector<std::string> finisher_names();

}  // namespace flankwright
