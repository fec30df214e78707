#include "optimize/solvers/nlopt_adapter.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <exception>
#include <new>
#include <nlopt.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace flankwright {

namespace {

/// First step of a derivative-free method, as a fraction of the variable's range, in (0, 1/2].
constexpr double kInitialStep = 0.1;

/// NLopt's mma and ccsaq solve a dual problem in each iteration, uninterruptibly; this many steps of it are enough
/// where the dual is well-conditioned, and keep an iteration below about a second for 500 constraints. >= 1.
constexpr double kDualSteps = 2000.0;

/// Populations that NLopt gives crs2_lm and isres: this many times (variables + 1).
constexpr int kCrs2Population = 10;
constexpr int kIsresPopulation = 20;

struct Algorithm {
  std::string_view name;
  nlopt::algorithm code;
};

constexpr std::array kAlgorithms{Algorithm{"nlopt:slsqp", nlopt::LD_SLSQP},       Algorithm{"nlopt:mma", nlopt::LD_MMA},
                                 Algorithm{"nlopt:ccsaq", nlopt::LD_CCSAQ},       Algorithm{"nlopt:lbfgs", nlopt::LD_LBFGS},
                                 Algorithm{"nlopt:cobyla", nlopt::LN_COBYLA},     Algorithm{"nlopt:bobyqa", nlopt::LN_BOBYQA},
                                 Algorithm{"nlopt:sbplx", nlopt::LN_SBPLX},       Algorithm{"nlopt:neldermead", nlopt::LN_NELDERMEAD},
                                 Algorithm{"nlopt:crs2_lm", nlopt::GN_CRS2_LM},   Algorithm{"nlopt:isres", nlopt::GN_ISRES},
                                 Algorithm{"nlopt:direct_l", nlopt::GN_DIRECT_L}, Algorithm{"nlopt:esch", nlopt::GN_ESCH},
                                 Algorithm{"nlopt:mlsl", nlopt::G_MLSL}};

nlopt::algorithm algorithm_named(std::string_view name) {
  const auto* found = std::find_if(kAlgorithms.begin(), kAlgorithms.end(), [&](const Algorithm& a) { return a.name == name; });
  assert(found != kAlgorithms.end() && "solve() checks the name");
  return found->code;
}

/// The data of the callbacks: the recorder, and substitutes for points that cannot be evaluated.
class Session {
 public:
  Session(Recorder& recorder, bool gradients) : recorder_(recorder), gradients_(gradients) {
    note(recorder.start(), recorder.at(recorder.start(), gradients));
  }

  /// From now on the run is over when this many points in a row lie within `tolerances` of the best one.
  void watch_population(int size, const Eigen::VectorXd& tolerances) {
    population_ = size;
    tolerances_ = tolerances;
  }
  bool population_collapsed() const { return population_ > 0 && close_in_a_row_ >= population_; }

  /// From now on the run is over when a step is within `tolerances`, inside a line search too. The line search of slsqp shortens a step that does
  /// not descend up to ten times, to a tenth each time, and NLopt tests whole iterations only.
  void watch_steps(const Eigen::VectorXd& tolerances) {
    watches_steps_ = true;
    tolerances_ = tolerances;
  }
  bool steps_ended() const { return steps_ended_; }

  double objective(const Eigen::VectorXd& x, double* gradient) {
    const Recorder::Point& point = recorder_.at(x, gradient != nullptr);
    note(x, point);
    if (watches_steps_) {
      steps_ended_ = last_.size() > 0 && x != last_ && ((x - last_).array().abs() <= tolerances_.array()).all();
      if (steps_ended_) throw StopRun{};
      last_ = x;
    }
    if (population_ > 0 && recorder_.best_x().size() > 0) {
      const bool close = ((x - recorder_.best_x()).array().abs() <= tolerances_.array()).all();
      close_in_a_row_ = close ? close_in_a_row_ + 1 : 0;
      if (population_collapsed()) throw StopRun{};
    }
    if (point.usable) {
      if (gradient != nullptr) std::copy_n(point.values.objective_gradient.data(), x.size(), gradient);
      return point.values.objective;
    }
    const double height = any_ ? worst_ + std::max(1.0, worst_ - least_) : 1.0;
    if (gradient != nullptr) {
      Eigen::Map<Eigen::VectorXd> slope(gradient, x.size());
      slope.setZero();
      if (any_) {
        const Eigen::VectorXd way = x - base_x_;
        const double square = way.squaredNorm();
        if (square > 0.0) slope = (height - base_.values.objective) / square * way;
      }
    }
    return height;
  }

  void constraints(const Eigen::VectorXd& x, double* values, double* jacobian) {
    const Recorder::Point& point = recorder_.at(x, jacobian != nullptr);
    note(x, point);
    const int m = recorder_.program().constraints();
    if (!point.usable && !(gradients_ && any_)) {
      std::fill_n(values, m, std::max(1.0, worst_violation_));
      if (jacobian != nullptr) std::fill_n(jacobian, m * x.size(), 0.0);
      return;
    }
    const ProgramValues& source = point.usable ? point.values : base_.values;
    std::copy_n(source.constraints.data(), m, values);
    if (jacobian == nullptr) return;
    // NLopt's Jacobian is stored by rows, Eigen's by columns.
    Eigen::Map<Eigen::MatrixXd>(jacobian, x.size(), m) = source.constraint_jacobian.transpose();
  }

 private:
  /// Base: of the usable points met, the one with the least violation, then the least objective.
  void note(const Eigen::VectorXd& x, const Recorder::Point& point) {
    // A known point without its gradients is an old one: noted when it was new.
    if (!point.usable || (gradients_ && point.values.objective_gradient.size() == 0)) return;
    const double f = point.values.objective;
    const bool better = !any_ || point.violation < base_.violation || (point.violation == base_.violation && f < base_.values.objective);
    if (better) {
      base_x_ = x;
      base_ = point;
    }
    worst_ = any_ ? std::max(worst_, f) : f;
    least_ = any_ ? std::min(least_, f) : f;
    worst_violation_ = std::max(worst_violation_, point.violation);
    any_ = true;
  }

  Recorder& recorder_;
  const bool gradients_;
  bool any_{false};  ///< a usable point was met; the rest below has a meaning only then
  Eigen::VectorXd base_x_;
  Recorder::Point base_;
  double worst_{0.0}, least_{0.0}, worst_violation_{0.0};

  int population_{0};  ///< 0: not watched
  int close_in_a_row_{0};
  bool watches_steps_{false}, steps_ended_{false};
  Eigen::VectorXd last_;  ///< the point that the method asked for last
  Eigen::VectorXd tolerances_;
};

double objective_callback(unsigned n, const double* x, double* gradient, void* session) {
  try {
    return static_cast<Session*>(session)->objective(Eigen::Map<const Eigen::VectorXd>(x, n), gradient);
  } catch (const StopRun&) {
    throw nlopt::forced_stop();
  }
}

void constraints_callback(unsigned, double* values, unsigned n, const double* x, double* jacobian, void* session) {
  try {
    static_cast<Session*>(session)->constraints(Eigen::Map<const Eigen::VectorXd>(x, n), values, jacobian);
  } catch (const StopRun&) {
    throw nlopt::forced_stop();
  }
}

/// The range of each variable, or max(1, |start|) where it has none.
std::vector<double> scales(const Recorder& recorder) {
  std::vector<double> scale(static_cast<std::size_t>(recorder.start().size()));
  for (std::size_t i = 0; i < scale.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double range = recorder.upper()[k] - recorder.lower()[k];
    scale[i] = std::isfinite(range) && range > 0.0 ? range : std::max(1.0, std::abs(recorder.start()[k]));
  }
  return scale;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

std::vector<double> to_std(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

void run(nlopt::opt& optimiser, std::vector<double>& x, SolverEnding& ending) {
  double objective = 0.0;
  ending.status = SolverStatus::Converged;
  try {
    switch (optimiser.optimize(x, objective)) {
      case nlopt::XTOL_REACHED:
        ending.message = "the steps are below the tolerance";
        break;
      case nlopt::FTOL_REACHED:
        ending.message = "the objective no longer changes";
        break;
      default:
        ending.message = "the method's own convergence test was met";
        break;
    }
  } catch (const nlopt::roundoff_limited&) {
    ending.message = "converged as far as round-off allows";
  } catch (const nlopt::forced_stop&) {
    ending.status = SolverStatus::Stalled;
    ending.message = "NLopt stopped itself";
  } catch (const std::bad_alloc&) {
    ending.status = SolverStatus::Failed;
    ending.message = "NLopt ran out of memory";
  } catch (const std::exception& error) {
    ending.status = SolverStatus::Failed;
    ending.message = std::string("NLopt gave up: ") + error.what();
  }
}

}  // namespace

SolverEnding solve_with_nlopt(Recorder& recorder, const SolverOptions& options) {
  const std::vector<double> scale = scales(recorder);
  const auto n = static_cast<unsigned>(scale.size());
  const auto m = static_cast<std::size_t>(recorder.program().constraints());
  nlopt::srand(options.seed);

  Session session(recorder, uses_gradients(options.name));
  const nlopt::algorithm code = algorithm_named(options.name);
  nlopt::opt optimiser(code, n);
  optimiser.set_min_objective(objective_callback, &session);
  if (m > 0) {
    optimiser.add_inequality_mconstraint(constraints_callback, &session, std::vector<double>(m, options.constraint_tolerance));
  }
  optimiser.set_lower_bounds(to_std(recorder.lower()));
  optimiser.set_upper_bounds(to_std(recorder.upper()));
  const std::vector<double> step_tolerances = scaled(scale, options.tolerance);
  if (code == nlopt::GN_CRS2_LM || code == nlopt::GN_ISRES) {
    // Their step between successive best points is small by chance now and then: no test of convergence.
    const int factor = code == nlopt::GN_CRS2_LM ? kCrs2Population : kIsresPopulation;
    session.watch_population(factor * static_cast<int>(n + 1), Eigen::Map<const Eigen::VectorXd>(step_tolerances.data(), n));
  } else {
    optimiser.set_xtol_abs(step_tolerances);
    if (code == nlopt::LD_SLSQP) session.watch_steps(Eigen::Map<const Eigen::VectorXd>(step_tolerances.data(), n));
  }
  optimiser.set_initial_step(scaled(scale, kInitialStep));
  if (code == nlopt::G_MLSL) {
    nlopt::opt local(nlopt::LD_LBFGS, n);
    local.set_xtol_abs(step_tolerances);
    optimiser.set_local_optimizer(local);
  }

  const bool restarts = code == nlopt::LD_MMA || code == nlopt::LD_CCSAQ;
  if (restarts) optimiser.set_param("dual_maxeval", kDualSteps);

  std::vector<double> x = to_std(recorder.start());
  SolverEnding ending;
  bool again = false;
  do {
    const double before = recorder.best_objective();
    const bool was_feasible = recorder.best_is_feasible();
    run(optimiser, x, ending);
    const bool gained =
        recorder.best_is_feasible() && (!was_feasible || recorder.best_objective() < before - options.tolerance * std::max(1.0, std::abs(before)));
    again = restarts && gained && recorder.stop_reason().status == SolverStatus::NotRun;
    if (again) x = to_std(recorder.best_x());
  } while (again);
  if (recorder.stop_reason().status != SolverStatus::NotRun) return recorder.stop_reason();
  if (session.population_collapsed()) return {SolverStatus::Converged, "the population has drawn together", recorder.best_x(), {}};
  if (session.steps_ended()) return {SolverStatus::Converged, "the steps are below the tolerance", recorder.best_x(), {}};
  ending.x = Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  if (!ending.x.allFinite()) {
    ending.x.resize(0);
    ending.status = SolverStatus::Stalled;
    ending.message += "; but the final point is not finite";
  }
  return ending;
}

}  // namespace flankwright
