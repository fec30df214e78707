#include "optimize/solvers/ipopt_adapter.hpp"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>

#include "core/base/one_blas_thread.hpp"

namespace flankwright {

namespace {

/// "Solved to acceptable level": the scaled first-order residual stayed <= kAcceptable * tolerance for
/// kAcceptableIterations iterations without reaching tolerance.
constexpr double kAcceptable = 100.0;
constexpr int kAcceptableIterations = 8;

/// Pairs of the limited-memory Hessian: as many as a dense one would need for the problems of this tool (4 to 14
/// variables).
constexpr int kHessianHistory = 12;

/// Ipopt takes what lies beyond +-1e19 as no bound.
constexpr double kNoBound = 2e19;

/// Serialises Ipopt's and MUMPS' own work across threads.
std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Gives the library up for the duration of a callback.
class Unlocked {
 public:
  explicit Unlocked(std::unique_lock<std::mutex>& lock) : lock_(lock) { lock_.unlock(); }
  ~Unlocked() { lock_.lock(); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  std::unique_lock<std::mutex>& lock_;
};

/// The recorded programme in Ipopt's terms. StopRun passes through the library, which then returns
/// NonIpopt_Exception_Thrown.
class RecordedProgram final : public Ipopt::TNLP {
 public:
  RecordedProgram(Recorder& recorder, std::unique_lock<std::mutex>& lock)
      : recorder_(recorder), lock_(lock), n_(recorder.program().variables()), m_(recorder.program().constraints()) {}

  SolverEnding& ending() { return ending_; }

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& nnz_jac_g, Ipopt::Index& nnz_h_lag, IndexStyleEnum& index_style) override {
    n = n_;
    m = m_;
    nnz_jac_g = n_ * m_;
    nnz_h_lag = 0;
    index_style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Ipopt::Index n, Ipopt::Number* x_l, Ipopt::Number* x_u, Ipopt::Index m, Ipopt::Number* g_l, Ipopt::Number* g_u) override {
    for (int i = 0; i < n; ++i) {
      x_l[i] = std::max(recorder_.lower()[i], -kNoBound);
      x_u[i] = std::min(recorder_.upper()[i], kNoBound);
    }
    std::fill_n(g_l, m, -kNoBound);
    std::fill_n(g_u, m, 0.0);
    return true;
  }

  bool get_starting_point(Ipopt::Index n, bool init_x, Ipopt::Number* x, bool init_z, Ipopt::Number*, Ipopt::Number*, Ipopt::Index, bool init_lambda,
                          Ipopt::Number*) override {
    if (init_z || init_lambda) return false;
    if (init_x) std::copy_n(recorder_.start().data(), n, x);
    return true;
  }

  bool eval_f(Ipopt::Index, const Ipopt::Number* x, bool, Ipopt::Number& objective) override {
    const Recorder::Point& point = at(x, false);
    if (point.usable) objective = point.values.objective;
    return point.usable;
  }

  bool eval_grad_f(Ipopt::Index n, const Ipopt::Number* x, bool, Ipopt::Number* gradient) override {
    const Recorder::Point& point = at(x, true);
    if (point.usable) std::copy_n(point.values.objective_gradient.data(), n, gradient);
    return point.usable;
  }

  bool eval_g(Ipopt::Index, const Ipopt::Number* x, bool, Ipopt::Index m, Ipopt::Number* constraints) override {
    const Recorder::Point& point = at(x, false);
    if (point.usable) std::copy_n(point.values.constraints.data(), m, constraints);
    return point.usable;
  }

  bool eval_jac_g(Ipopt::Index, const Ipopt::Number* x, bool, Ipopt::Index, Ipopt::Index, Ipopt::Index* rows, Ipopt::Index* columns,
                  Ipopt::Number* values) override {
    // Dense, by columns: the order of Eigen's storage.
    if (values == nullptr) {
      for (int j = 0, k = 0; j < n_; ++j) {
        for (int i = 0; i < m_; ++i, ++k) {
          rows[k] = i;
          columns[k] = j;
        }
      }
      return true;
    }
    const Recorder::Point& point = at(x, true);
    if (point.usable) std::copy_n(point.values.constraint_jacobian.data(), n_ * m_, values);
    return point.usable;
  }

  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index n, const Ipopt::Number* x, const Ipopt::Number*, const Ipopt::Number*, Ipopt::Index m,
                         const Ipopt::Number*, const Ipopt::Number* lambda, Ipopt::Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    ending_.x = Eigen::Map<const Eigen::VectorXd>(x, n);
    // L = f + lambda' c - ...: non-negative for c <= 0 but for round-off.
    ending_.multipliers = Eigen::Map<const Eigen::VectorXd>(lambda, m).cwiseMax(0.0);
  }

 private:
  const Recorder::Point& at(const Ipopt::Number* x, bool gradients_needed) {
    const Unlocked unlocked(lock_);
    return recorder_.at(Eigen::Map<const Eigen::VectorXd>(x, n_), gradients_needed);
  }

  Recorder& recorder_;
  std::unique_lock<std::mutex>& lock_;
  const int n_, m_;
  SolverEnding ending_;
};

void set_options(Ipopt::OptionsList& list, const SolverOptions& options) {
  list.SetStringValue("sb", "yes");
  list.SetIntegerValue("print_level", 0);
  list.SetStringValue("linear_solver", "mumps");
  list.SetStringValue("hessian_approximation", "limited-memory");
  list.SetIntegerValue("limited_memory_max_history", kHessianHistory);
  // Fewer evaluations than "monotone" on the problem library in tests/problems/: Rosenbrock 33 against 64.
  list.SetStringValue("mu_strategy", "adaptive");
  // Epigraphs with many candidates drop Ipopt into its monotone mode, where it crawls: 5 design problems took 318 analyses
  // without that mode and 1321 with it, to the same or better optima. The filter line search still globalises.
  list.SetStringValue("adaptive_mu_globalization", "never-monotone-mode");
  list.SetNumericValue("tol", options.tolerance);
  list.SetNumericValue("constr_viol_tol", options.constraint_tolerance);
  list.SetNumericValue("acceptable_tol", kAcceptable * options.tolerance);
  list.SetNumericValue("acceptable_constr_viol_tol", options.constraint_tolerance);
  list.SetIntegerValue("acceptable_iter", kAcceptableIterations);
  list.SetNumericValue("bound_relax_factor", 0.0);
  list.SetStringValue("honor_original_bounds", "yes");
  // Every iteration evaluates at least one new point, so the recorder's limit comes first.
  list.SetIntegerValue("max_iter", options.max_evaluations);
}

SolverStatus status_of(Ipopt::ApplicationReturnStatus code, std::string& message) {
  switch (code) {
    case Ipopt::Solve_Succeeded:
      message = "the first-order residual is below the tolerance";
      return SolverStatus::Converged;
    case Ipopt::Solved_To_Acceptable_Level:
      message = "solved to acceptable level: the first-order residual settled below 100 times the tolerance";
      return SolverStatus::Converged;
    case Ipopt::Feasible_Point_Found:
      message = "a feasible point was found";
      return SolverStatus::Converged;
    case Ipopt::Infeasible_Problem_Detected:
      message = "the constraints cannot be met near here: their violation has a local minimum";
      return SolverStatus::Infeasible;
    case Ipopt::Search_Direction_Becomes_Too_Small:
      message = "the search direction became too small";
      return SolverStatus::Stalled;
    case Ipopt::Maximum_Iterations_Exceeded:
      message = "the iteration limit was reached";
      return SolverStatus::EvaluationLimit;
    case Ipopt::Restoration_Failed:
      message = "the feasibility restoration failed";
      return SolverStatus::Stalled;
    case Ipopt::Error_In_Step_Computation:
      message = "the step could not be computed: the linear system is too ill-conditioned";
      return SolverStatus::Stalled;
    case Ipopt::Diverging_Iterates:
      message = "the iterates diverge: the programme may be unbounded";
      return SolverStatus::Failed;
    case Ipopt::Invalid_Number_Detected:
      message = "no usable point near the start";
      return SolverStatus::Failed;
    default:
      message = "Ipopt gave up with code " + std::to_string(static_cast<int>(code));
      return SolverStatus::Failed;
  }
}

}  // namespace

SolverEnding solve_with_ipopt(Recorder& recorder, const SolverOptions& options) {
  const OneBlasThread one_thread;
  std::unique_lock<std::mutex> lock(library_mutex());
  auto* program = new RecordedProgram(recorder, lock);  // owned by the smart pointer
  const Ipopt::SmartPtr<Ipopt::TNLP> owner = program;
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  set_options(*application->Options(), options);

  SolverEnding ending;
  const auto ready = application->Initialize("");  // no option file
  if (ready != Ipopt::Solve_Succeeded) {
    ending.status = status_of(ready, ending.message);
    return ending;
  }
  const auto code = application->OptimizeTNLP(owner);
  if (recorder.stop_reason().status != SolverStatus::NotRun) return recorder.stop_reason();
  ending = program->ending();
  ending.status = status_of(code, ending.message);
  return ending;
}

}  // namespace flankwright
