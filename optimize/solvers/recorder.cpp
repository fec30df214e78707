#include "optimize/solvers/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <utility>

#include "core/base/error.hpp"

namespace flankwright {

namespace {

/// Gradients are kept for this many points, counted back from the newest, >= 1.
constexpr std::size_t kGradientsKept = 64;

/// A library that asks for more than this many known points in a row is going round in circles.
constexpr int kKnownInARow = 5000;

/// A start is clipped to its bounds where it lies outside by no more than kStartSlack * max(1, |bound|), the round-off
/// of a change of units or scale.
constexpr double kStartSlack = 1e-9;

/// See SolverResult::x: the factor of constraint_tolerance * max(1, |objective|).
constexpr double kViolationGain = 10.0;

/// A library's final point counts as converged to the feasible point kept where its violation is no more than
/// kNearlyFeasible * constraint_tolerance: the remainder of a last step within the step tolerance where constraints are
/// steep.
constexpr double kNearlyFeasible = 100.0;

std::string bytes_of(const Eigen::VectorXd& x) {
  return {reinterpret_cast<const char*>(x.data()), static_cast<std::size_t>(x.size()) * sizeof(double)};
}

void require_size(const char* field, Eigen::Index found, int expected) {
  if (found != expected) throw InvalidInput(field, std::to_string(found) + " entries", std::to_string(expected));
}

/// Throws where an array of the values has the wrong size.
void require_sizes(const ProgramValues& values, int n, int m, bool with_gradients) {
  require_size("constraints", values.constraints.size(), m);
  if (!with_gradients) return;
  require_size("objective_gradient", values.objective_gradient.size(), n);
  if (m == 0) return;
  require_size("constraint_jacobian rows", values.constraint_jacobian.rows(), m);
  require_size("constraint_jacobian columns", values.constraint_jacobian.cols(), n);
}

/// Throws where a value is not finite.
void require_finite(const ProgramValues& values, bool with_gradients) {
  if (!std::isfinite(values.objective)) throw std::domain_error("the objective is not finite");
  if (!values.constraints.allFinite()) throw std::domain_error("a constraint is not finite");
  if (!with_gradients) return;
  if (!values.objective_gradient.allFinite()) throw std::domain_error("the objective's gradient is not finite");
  if (!values.constraint_jacobian.allFinite()) throw std::domain_error("the constraints' Jacobian is not finite");
}

}  // namespace

Recorder::Recorder(NonlinearProgram& program, const SolverOptions& options, bool with_gradients)
    : program_(program),
      options_(options),
      with_gradients_(with_gradients),
      begin_(std::chrono::steady_clock::now()),
      lower_(program.lower()),
      upper_(program.upper()),
      start_(program.start()) {
  const int n = program.variables();
  if (n < 1) throw InvalidInput("variables", std::to_string(n), "at least 1");
  if (program.constraints() < 0) throw InvalidInput("constraints", std::to_string(program.constraints()), "at least 0");
  require_size("lower bounds", lower_.size(), n);
  require_size("upper bounds", upper_.size(), n);
  require_size("start", start_.size(), n);
  for (int i = 0; i < n; ++i) {
    const auto labelled = [i](std::string name) { return name.append("[").append(std::to_string(i)).append("]"); };
    if (!(lower_[i] <= upper_[i])) {
      throw InvalidInput(labelled("bounds"), std::to_string(lower_[i]) + " .. " + std::to_string(upper_[i]), "a lower bound not above the upper");
    }
    const bool below = start_[i] < lower_[i] - kStartSlack * std::max(1.0, std::abs(lower_[i]));
    const bool above = start_[i] > upper_[i] + kStartSlack * std::max(1.0, std::abs(upper_[i]));
    if (!std::isfinite(start_[i]) || below || above) {
      throw InvalidInput(labelled("start"), std::to_string(start_[i]), std::to_string(lower_[i]) + " .. " + std::to_string(upper_[i]));
    }
  }
  start_ = start_.cwiseMax(lower_).cwiseMin(upper_);
}

const Recorder::Point& Recorder::at(const Eigen::VectorXd& x_asked, bool gradients_needed) {
  if (stop_reason_.status != SolverStatus::NotRun) throw StopRun{};
  if (!x_asked.allFinite()) stop(SolverStatus::Stalled, "the solver proposed a point that is not finite");
  if (seconds() > options_.max_seconds) stop(SolverStatus::TimeLimit, "the time limit was reached");

  // The sum turns -0 into +0, so that equal points have equal bytes.
  const Eigen::VectorXd x = (x_asked.cwiseMax(lower_).cwiseMin(upper_).array() + 0.0).matrix();
  std::string key = bytes_of(x);
  const auto known = points_.find(key);
  if (known != points_.end()) {
    const Point& point = known->second;
    const bool complete = !point.usable || !gradients_needed || point.values.objective_gradient.size() > 0;
    if (complete) {
      if (++known_in_a_row_ > kKnownInARow) stop(SolverStatus::Stalled, "the solver keeps returning to known points");
      return point;
    }
  }
  if (evaluations_ >= options_.max_evaluations) {
    // Of a search that goes on after another one the limit is what the other has left.
    stop(SolverStatus::EvaluationLimit, "optimise.max_evaluations was reached, after " + std::to_string(options_.max_evaluations) +
                                            (options_.max_evaluations == 1 ? " evaluation" : " evaluations") + " in this search");
  }

  known_in_a_row_ = 0;
  Point& point = points_.insert_or_assign(std::move(key), evaluate(x)).first->second;
  history_.push_back({evaluations_, point.values.objective, point.violation});
  if (point.usable) {
    keep_if_best(x, point);
    keep_gradients_of(point);
  }
  if (options_.progress) {
    const bool any = best_x_.size() > 0 && feasible(best_violation_);
    try {
      options_.progress(evaluations_, any ? best_objective_ : std::numeric_limits<double>::quiet_NaN());
    } catch (const std::exception& error) {
      stop(SolverStatus::Failed, std::string("the progress callback ended the run: ") + error.what());
    } catch (...) {
      stop(SolverStatus::Failed, "the progress callback ended the run");
    }
  }
  if (const std::string why = options_.stop_when ? options_.stop_when() : ""; !why.empty()) stop(SolverStatus::Stalled, why);
  return point;
}

Recorder::Point Recorder::evaluate(const Eigen::VectorXd& x) {
  ++evaluations_;
  if (with_gradients_) ++gradient_evaluations_;
  std::string failure;
  try {
    Point point;
    point.values = program_.evaluate(x, with_gradients_);
    require_sizes(point.values, program_.variables(), program_.constraints(), with_gradients_);
    require_finite(point.values, with_gradients_);
    point.usable = true;
    point.violation = 0.0;
    if (point.values.constraints.size() > 0) point.violation = std::max(0.0, point.values.constraints.maxCoeff());
    return point;
  } catch (const std::exception& error) {
    failure = error.what();
  } catch (...) {
    failure = "an unknown exception";
  }
  if (failures_++ == 0) first_failure_ = failure;
  return {};
}

void Recorder::keep_if_best(const Eigen::VectorXd& x, const Point& point) {
  const bool better = feasible(point.violation) ? !feasible(best_violation_) || point.values.objective < best_objective_
                                                : !feasible(best_violation_) && point.violation < best_violation_;
  if (!better && best_x_.size() > 0) return;
  best_x_ = x;
  best_objective_ = point.values.objective;
  best_violation_ = point.violation;
}

void Recorder::keep_gradients_of(Point& point) {
  if (!with_gradients_) return;
  with_kept_gradients_.push_back(&point);
  if (with_kept_gradients_.size() <= kGradientsKept) return;
  Point* oldest = with_kept_gradients_.front();
  with_kept_gradients_.pop_front();
  oldest->values.objective_gradient.resize(0);
  oldest->values.constraint_jacobian.resize(0, 0);
}

void Recorder::stop(SolverStatus status, const std::string& message) {
  stop_reason_.status = status;
  stop_reason_.message = message;
  throw StopRun{};
}

double Recorder::seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

SolverResult Recorder::result(SolverEnding ending) {
  SolverResult result;
  result.status = ending.status;
  result.message = std::move(ending.message);
  result.solver = options_.name;
  // The library's final point comes first: it may never have been evaluated. At a limit it stays unknown.
  const Point* last = nullptr;
  if (ending.status == SolverStatus::Converged && ending.x.size() > 0) {
    try {
      last = &at(ending.x, false);
    } catch (const StopRun&) {
      result.message += "; the final point was not evaluated";
    }
  }

  const bool any = best_x_.size() > 0;
  const bool any_feasible = any && feasible(best_violation_);
  if (any) {
    result.x = best_x_;
    result.objective = best_objective_;
    result.constraint_violation = best_violation_;
  }

  if (!any) {
    result.status = SolverStatus::Failed;
    result.message += "; no point could be evaluated: " + first_failure_;
  } else if (ending.status == SolverStatus::Converged && !any_feasible) {
    result.status = SolverStatus::Infeasible;
    result.message += "; no feasible point was met, the least violation is " + std::to_string(best_violation_);
  } else if (ending.status == SolverStatus::Infeasible && any_feasible) {
    result.status = SolverStatus::Stalled;
    result.message += "; feasible points were met before";
  } else if (ending.status == SolverStatus::Converged) {
    const double gain = kViolationGain * options_.constraint_tolerance * std::max(1.0, std::abs(best_objective_));
    const bool as_good = last != nullptr && last->usable && last->values.objective <= best_objective_ + gain;
    if (as_good && feasible(last->violation)) {
      result.x = ending.x.cwiseMax(lower_).cwiseMin(upper_);
      result.objective = last->values.objective;
      result.constraint_violation = last->violation;
      result.multipliers = std::move(ending.multipliers);
    } else if (last != nullptr && !last->usable) {
      result.status = SolverStatus::Stalled;
      result.message += "; but the final point cannot be evaluated";
    } else if (last != nullptr && !(as_good && last->violation <= kNearlyFeasible * options_.constraint_tolerance)) {
      result.status = SolverStatus::Stalled;
      result.message += "; but a better point was met on the way";
    }
  }
  if (any && failures_ > 0) {
    result.message +=
        "; " + std::to_string(failures_) + (failures_ == 1 ? " evaluation" : " evaluations") + " failed, the first with: " + first_failure_;
  }
  result.evaluations = evaluations_;
  result.gradient_evaluations = gradient_evaluations_;
  result.failures = failures_;
  result.history = std::move(history_);
  result.seconds = seconds();
  return result;
}

}  // namespace flankwright
