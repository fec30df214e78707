#include "core/load/load_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/root.hpp"
#include "core/load/quadratic_program.hpp"

namespace flankwright {

namespace {

/// The slope of the contact law is log-infinite at no load; the quadratic model uses it at this share of the mean load.
constexpr double slope_floor = 1e-9;
/// A Newton step is taken whole where slope(1) <= overshoot * |slope(0)|.
constexpr double overshoot = 0.5;
/// Where contact is stiff on a nearly singular structure, loads may be 1e-8 off when the residual has met its bound. With contact laws, which
/// alone make them unique, the last step must have moved no load by more than this share of the largest: the next one, squared, would be lost in
/// round-off. Without, loads that cause no deflection are free.
constexpr double settled = 1e-7;

void check(const LoadProblem& problem, const Eigen::VectorXd& start) {
  const Eigen::Index n = problem.gap.size();
  const auto sizes_match = problem.weight.size() == n && problem.influence.rows() == n &&
                           problem.influence.cols() == n &&
                           (problem.laws.empty() || static_cast<Eigen::Index>(problem.laws.size()) == n) &&
                           (start.size() == 0 || start.size() == n);
  if (!sizes_match) throw InvalidInput("load problem", "arrays of different size", "one entry per contact point");
  if (!problem.gap.allFinite() || !problem.influence.allFinite() || !problem.weight.allFinite()) {
    throw InvalidInput("load problem", "not finite", "finite gaps, influences and weights");
  }
  if (n > 0 && !(problem.weight.minCoeff() > 0.0)) {
    throw InvalidInput("weight", std::to_string(problem.weight.minCoeff()), "above 0 mm");
  }
  if (!(problem.force >= 0.0) || !std::isfinite(problem.force)) {
    throw InvalidInput("force", std::to_string(problem.force), "finite and >= 0 N");
  }
}

/// State of the Newton iteration: loads and everything that follows from them, each contact law evaluated once.
///
/// Gaps and approach count from first touch, min(g): a gap common to all points, easily a million times the deflection
/// under a light load, would leave its round-off in every sum.
class Iterate {
 public:
  Iterate(const LoadProblem& problem, Eigen::VectorXd w)
      : w_(std::move(w)), structural_(problem.influence * problem.weight.cwiseProduct(w_)),
        local_(Eigen::VectorXd::Zero(w_.size())), local_slope_(Eigen::VectorXd::Zero(w_.size())),
        approach_(structural_ + (problem.gap.array() - problem.gap.minCoeff()).matrix()) {
    const double floor = slope_floor * problem.force / problem.weight.sum();
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(problem.laws.size()); ++i) {
      const ContactLaw& law = problem.laws[static_cast<std::size_t>(i)];
      if (w_[i] > floor) {
        const ContactLaw::Response response = law.evaluate(w_[i]);
        local_[i] = response.deflection;
        local_slope_[i] = response.slope;
      } else {
        local_[i] = law.deflection(w_[i]);
        local_slope_[i] = law.slope(floor);
      }
    }
    approach_ += local_;
  }

  const Eigen::VectorXd& loads() const { return w_; }
  /// Gradient of the objective divided by the weights: the deflection plus gap at each point [mm].
  const Eigen::VectorXd& approach() const { return approach_; }
  const Eigen::VectorXd& structural() const { return structural_; }
  const Eigen::VectorXd& local() const { return local_; }
  const Eigen::VectorXd& local_slope() const { return local_slope_; }

 private:
  Eigen::VectorXd w_, structural_, local_, local_slope_, approach_;
};

/// A Newton step's objective along the straight line from one iterate to the next.
class Step {
 public:
  /// @param f  approach, taken out of every term (a'd = 0 along a feasible step), so that what is summed is as small as the residual
  ///           and not as large as the deflection
  Step(const LoadProblem& problem, const Iterate& from, const Iterate& to, double f)
      : problem_(problem), from_(from), to_(to), f_(f), forces_(problem.weight.cwiseProduct(to.loads() - from.loads())) {}

  double slope_at_start() const { return forces_.dot((from_.approach().array() - f_).matrix()); }
  double slope_at_end() const { return forces_.dot((to_.approach().array() - f_).matrix()); }
  double slope(double t) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < forces_.size(); ++i) {
      // All but the contact law is linear in t.
      const double linear = between(from_.approach()[i] - from_.local()[i], to_.approach()[i] - to_.local()[i], t);
      const double load = std::max(0.0, between(from_.loads()[i], to_.loads()[i], t));
      const double local = problem_.laws.empty() ? 0.0 : problem_.laws[static_cast<std::size_t>(i)].deflection(load);
      sum += forces_[i] * (linear + local - f_);
    }
    return sum;
  }
  Eigen::VectorXd loads(double t) const { return (from_.loads() + t * (to_.loads() - from_.loads())).cwiseMax(0.0); }

 private:
  static double between(double start, double end, double t) { return start + t * (end - start); }

  const LoadProblem& problem_;
  const Iterate &from_, &to_;
  double f_;
  Eigen::VectorXd forces_;
};

/// f_t from first touch for given loads: the mean approach of the loaded points, weighted by the force they carry.
double best_multiplier(const LoadProblem& problem, const Iterate& at) {
  const Eigen::VectorXd share = problem.weight.cwiseProduct(at.loads());
  return share.dot(at.approach()) / share.sum();
}

double kkt_residual(const LoadProblem& problem, const Iterate& at, double f) {
  const Eigen::VectorXd remaining = at.approach().array() - f;
  const Eigen::VectorXd terms = problem.influence.cwiseAbs() * problem.weight.cwiseProduct(at.loads()) + at.local();
  double worst = 0.0, scale = 0.0;
  for (Eigen::Index i = 0; i < remaining.size(); ++i) {
    const bool loaded = at.loads()[i] > 0.0;
    worst = std::max(worst, loaded ? std::abs(remaining[i]) : -remaining[i]);
    if (loaded) scale = std::max(scale, terms[i]);
  }
  const double balance = std::abs(problem.weight.dot(at.loads()) - problem.force) / problem.force;
  return std::max(balance, worst / scale);
}

/// See LoadDistribution::condition.
double condition_of(const QuadraticMinimum& model) {
  if (model.factorisations == 0 || model.factor.info() != Eigen::Success) return not_given;
  const double reciprocal = model.factor.rcond();
  return reciprocal > 0.0 ? 1.0 / reciprocal : std::numeric_limits<double>::infinity();
}

void fill(const LoadProblem& problem, const Iterate& at, double f, LoadDistribution& result) {
  result.line_load = at.loads();
  result.contact_deflection = at.local();
  result.structural_deflection = at.structural();
  result.transmission_error = problem.gap.minCoeff() + f;
  result.remaining_gap = at.approach().array() - f;
}

/// No force: the flanks just touch where the gap is least.
LoadDistribution unloaded(const LoadProblem& problem) {
  LoadDistribution result;
  const Eigen::Index n = problem.gap.size();
  result.status = LoadStatus::Converged;
  result.message = "no force";
  result.line_load = result.contact_deflection = result.structural_deflection = Eigen::VectorXd::Zero(n);
  result.transmission_error = problem.gap.minCoeff();
  result.remaining_gap = problem.gap.array() - result.transmission_error;
  result.kkt_residual = 0.0;
  result.iterations = result.factorisations = 0;
  return result;
}

}  // namespace

LoadDistribution solve_load_distribution(const LoadProblem& problem, const LoadOptions& options,
                                         const Eigen::VectorXd& start) {
  check(problem, start);
  LoadDistribution result;
  const Eigen::Index n = problem.gap.size();
  if (n == 0) {
    result.status = LoadStatus::NoContactPoints;
    result.message = "no contact point at this mesh position";
    return result;
  }
  if (problem.force == 0.0) return unloaded(problem);

  const Eigen::VectorXd& a = problem.weight;
  const bool warm = start.size() == n && start.minCoeff() >= 0.0 && a.dot(start) > 0.0;
  Iterate at(problem, warm ? Eigen::VectorXd(start * (problem.force / a.dot(start)))
                           : Eigen::VectorXd::Constant(n, problem.force / a.sum()));
  const Eigen::MatrixXd structural_hessian = a.asDiagonal() * problem.influence * a.asDiagonal();
  Eigen::MatrixXd hessian = structural_hessian;
  result.factorisations = 0;
  double load_step = std::numeric_limits<double>::infinity();
  QuadraticMinimum model;
  for (result.iterations = 0;; ++result.iterations) {
    const double f = best_multiplier(problem, at);
    result.kkt_residual = kkt_residual(problem, at, f);
    const bool converged = result.kkt_residual <= options.tolerance && (problem.laws.empty() || load_step <= settled);
    if (converged || result.iterations == options.max_iterations) {
      fill(problem, at, f, result);
      result.condition = condition_of(model);
      result.status = converged ? LoadStatus::Converged : LoadStatus::IterationLimit;
      result.message = converged ? "converged"
                                 : "the load distribution did not converge within " +
                                       std::to_string(options.max_iterations) + " Newton steps";
      return result;
    }
    hessian.diagonal() = structural_hessian.diagonal() + a.cwiseProduct(at.local_slope());
    const Eigen::VectorXd linear = a.cwiseProduct(at.approach()) - hessian * at.loads();
    model = minimise_quadratic(hessian, linear, a, problem.force, at.loads().array() > 0.0);
    result.factorisations += model.factorisations;

    Iterate next(problem, model.x);
    const Step step(problem, at, next, f);
    const double slope_start = step.slope_at_start(), slope_end = step.slope_at_end();
    // The whole step where it at least halves the slope, else to the minimum along it.
    if (slope_end > overshoot * std::abs(slope_start) && slope_start < 0.0) {
      const double t = bracketed_root([&](double s) { return step.slope(s); }, 0.0, slope_start, 1.0, slope_end, 1e-3).x;
      next = Iterate(problem, step.loads(t));
    }
    load_step = (next.loads() - at.loads()).lpNorm<Eigen::Infinity>() / next.loads().maxCoeff();
    at = std::move(next);
  }
}

}  // namespace flankwright
