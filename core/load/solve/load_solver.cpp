#include "core/load/solve/load_solver.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/root.hpp"
#include "core/base/wide_sum.hpp"

namespace flankwright {

namespace {

/// The slope of the contact law is log-infinite at no load; the quadratic model uses it at this share of the mean load.
constexpr double slope_floor = 1e-9;
/// A Newton step is taken whole where slope(1) <= overshoot * |slope(0)|.
constexpr double overshoot = 0.5;
/// Where contact is stiff on a nearly singular structure, loads may be 1e-8 off when the residual has met its bound. With contact laws, which
/// alone make them unique, either the last step must have moved no load by more than `last_step` of the largest: the next one, squared, would be
/// lost in round-off. Or what the last factor makes of the residual that is left must be no more than `last_correction` of it.
/// Without laws, loads that cause no deflection are free.
constexpr double last_step = 1e-7;
constexpr double last_correction = 1e-11;
/// Points join the working set that the start leaves less than this share of the approach away from contact.
constexpr double contact_reach = 0.02;
/// The factor of the last step serves the derivatives too where no diagonal entry of H has changed by more than this share since.
constexpr double same_factor = 1e-9;

/// influence * forces, over the columns of the points that have a force: seldom half of them, and the matrix is what takes the time to read.
void deflect(const Eigen::MatrixXd& influence, const Eigen::VectorXd& forces, Eigen::VectorXd& deflection) {
  const Eigen::Index n = forces.size();
  deflection.setZero(n);
  std::array<const double*, 4> column{};
  std::array<double, 4> force{};
  std::size_t some = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    if (forces[j] == 0.0) continue;
    column[some] = influence.data() + j * n;
    force[some++] = forces[j];
    if (some < column.size()) continue;
    some = 0;
    add_four_columns(column, force, n, deflection.data());
  }
  for (std::size_t k = 0; k < some; ++k) deflection += force[k] * Eigen::Map<const Eigen::VectorXd>(column[k], n);
}

void check(const LoadProblemView& problem, const Eigen::VectorXd& start) {
  const Eigen::Index n = problem.gap.size();
  const auto sizes_match = problem.weight.size() == n && problem.influence.rows() == n && problem.influence.cols() == n &&
                           (problem.laws.empty() || static_cast<Eigen::Index>(problem.laws.size()) == n) && (start.size() == 0 || start.size() == n);
  if (!sizes_match) throw InvalidInput("load problem", "arrays of different size", "one entry per contact point");
  if (!problem.gap.allFinite() || !problem.weight.allFinite()) {
    throw InvalidInput("load problem", "not finite", "finite gaps, influences and weights");
  }
  if (n > 0 && !(problem.weight.minCoeff() > 0.0)) {
    throw InvalidInput("weight", std::to_string(problem.weight.minCoeff()), "above 0 mm");
  }
  if (!(problem.force >= 0.0) || !std::isfinite(problem.force)) {
    throw InvalidInput("force", std::to_string(problem.force), "finite and >= 0 N");
  }
}

/// No force: the flanks just touch where the gap is least.
LoadDistribution unloaded(const LoadProblemView& problem) {
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

/// Loads to start from, balancing the force.
Eigen::VectorXd balanced(const LoadProblemView& problem, const Eigen::VectorXd& start) {
  const Eigen::VectorXd& a = problem.weight;
  const bool warm = start.size() == a.size() && start.minCoeff() >= 0.0 && a.dot(start) > 0.0;
  if (!warm) return Eigen::VectorXd::Constant(a.size(), problem.force / a.sum());
  return start * (problem.force / a.dot(start));
}

}  // namespace

LoadDistribution LoadSolver::solve(const LoadProblemView& problem, const LoadOptions& options, const Eigen::VectorXd& start) {
  check(problem, start);
  LoadDistribution result;
  const Eigen::Index n = problem.gap.size();
  if (n == 0) {
    result.status = LoadStatus::NoContactPoints;
    result.message = "no contact point at this mesh position";
    return result;
  }
  const Eigen::VectorXd loads = balanced(problem, start);
  find_deflection(problem, loads);
  if (problem.force == 0.0) return unloaded(problem);
  force_ = problem.force;
  load_floor_ = slope_floor * force_ / problem.weight.sum();
  first_touch_ = problem.gap.minCoeff();
  gap_ = problem.gap.array() - first_touch_;
  work_on(problem, loads, points_near_contact(problem, loads));
  load_step_ = std::numeric_limits<double>::infinity();
  result.iterations = result.factorisations = 0;
  bool converged = false;
  do {
    converged = newton(options, result);
  } while (converged && add_penetrating(problem, options, result));
  fill(result);
  result.status = converged ? LoadStatus::Converged : LoadStatus::IterationLimit;
  result.message =
      converged ? "converged" : "the load distribution did not converge within " + std::to_string(options.max_iterations) + " Newton steps";
  return result;
}

/// Of the structure, at all points. A non-finite influence of a loaded point shows here.
void LoadSolver::find_deflection(const LoadProblemView& problem, const Eigen::VectorXd& loads) {
  forces_ = problem.weight.cwiseProduct(loads);
  deflect(problem.influence, forces_, structural_);
  if (!structural_.allFinite() && !problem.influence.allFinite()) {
    throw InvalidInput("load problem", "not finite", "finite gaps, influences and weights");
  }
}

LoadSolver::Flags LoadSolver::points_near_contact(const LoadProblemView& problem, const Eigen::VectorXd& loads) const {
  Eigen::Index most = 0;
  const double largest = loads.maxCoeff(&most);
  const double local = problem.laws.empty() ? 0.0 : problem.laws[static_cast<std::size_t>(most)].deflection(largest);
  const double approach = structural_[most] + gap_[most] + local;
  return loads.array() > 0.0 || (structural_ + gap_).array() < (1.0 + contact_reach) * approach;
}

/// Points that the working set leaves out and its answer makes penetrate join it.
/// @returns whether there are any
bool LoadSolver::add_penetrating(const LoadProblemView& problem, const LoadOptions& options, LoadDistribution& result) {
  const Eigen::Index n = gap_.size();
  if (std::ssize(points_) == n) {
    structural_ = at_.structural;
    return false;
  }
  Eigen::VectorXd loads = Eigen::VectorXd::Zero(n);
  loads(points_) = at_.loads;
  find_deflection(problem, loads);
  Flags working = (structural_ + gap_).array() < at_.multiplier;
  double deepest = 0.0;
  for (Eigen::Index i = 0, k = 0; i < n; ++i) {
    const bool inside = k < std::ssize(points_) && points_[static_cast<std::size_t>(k)] == i;
    if (!inside && working[i]) deepest = std::max(deepest, at_.multiplier - structural_[i] - gap_[i]);
    working[i] = working[i] || inside;
    k += inside;
  }
  const double violation = deepest / deflection_scale();
  if (violation > options.tolerance) {
    work_on(problem, loads, working);
    return true;
  }
  result.kkt_residual = std::max(result.kkt_residual, violation);
  return false;
}

void LoadSolver::fill(LoadDistribution& result) const {
  const Eigen::Index n = gap_.size();
  result.line_load = result.contact_deflection = Eigen::VectorXd::Zero(n);
  result.line_load(points_) = at_.loads;
  result.contact_deflection(points_) = at_.local;
  result.structural_deflection = structural_;
  result.transmission_error = first_touch_ + at_.multiplier;
  result.remaining_gap = (structural_ + gap_ + result.contact_deflection).array() - at_.multiplier;
  result.condition = condition();
}

void LoadSolver::work_on(const LoadProblemView& problem, const Eigen::VectorXd& loads, const Flags& working) {
  const Eigen::Index n = loads.size();
  points_.clear();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (working[i]) points_.push_back(i);
  }
  const Eigen::Index size = std::ssize(points_);
  at_.loads = loads(points_);
  weight_ = problem.weight(points_);
  near_gap_ = gap_(points_);
  influence_.resize(size, size);
  hessian_.resize(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const double* from = problem.influence.data() + points_[static_cast<std::size_t>(j)] * n;
    double* to = influence_.data() + j * size;
    for (Eigen::Index i = 0; i < size; ++i) to[i] = from[points_[static_cast<std::size_t>(i)]];
    hessian_.col(j) = weight_[j] * weight_.cwiseProduct(influence_.col(j));
  }
  const double least = influence_.minCoeff(), most = influence_.maxCoeff();
  has_negative_influence_ = least < 0.0;
  largest_influence_ = std::max(most, -least);
  stiff_diagonal_ = hessian_.diagonal();
  laws_.clear();
  if (!problem.laws.empty()) {
    for (const Eigen::Index i : points_) laws_.push_back(&problem.laws[static_cast<std::size_t>(i)]);
  }
  floor_slope_ = Eigen::VectorXd::Constant(size, not_given);
  has_factor_ = false;
  evaluate(at_);
}

/// @param at  loads given, the rest to be found
void LoadSolver::evaluate(Iterate& at) {
  const Eigen::Index size = at.loads.size();
  forces_ = weight_.cwiseProduct(at.loads);
  deflect(influence_, forces_, at.structural);
  at.local.setZero(size);
  at.local_slope.setZero(size);
  for (Eigen::Index i = 0; i < std::ssize(laws_); ++i) {
    const ContactLaw& law = *laws_[static_cast<std::size_t>(i)];
    if (at.loads[i] > load_floor_) {
      const ContactLaw::Response response = law.evaluate(at.loads[i]);
      at.local[i] = response.deflection;
      at.local_slope[i] = response.slope;
      continue;
    }
    if (at.loads[i] > 0.0) at.local[i] = law.deflection(at.loads[i]);
    if (std::isnan(floor_slope_[i])) floor_slope_[i] = law.slope(load_floor_);
    at.local_slope[i] = floor_slope_[i];
  }
  at.approach = at.structural + near_gap_ + at.local;
  at.multiplier = forces_.dot(at.approach) / forces_.sum();
}

/// The largest deflection of a loaded point, sum_j |K_ij| a_j w_j + c_i.
double LoadSolver::deflection_scale() const {
  const Eigen::VectorXd magnitudes =
      has_negative_influence_ ? Eigen::VectorXd(influence_.cwiseAbs() * weight_.cwiseProduct(at_.loads)) : at_.structural;
  return (at_.loads.array() > 0.0).select(magnitudes + at_.local, 0.0).maxCoeff();
}

/// @param reached  a residual above it may be returned smaller than it is, though not below `reached`
double LoadSolver::residual(double reached) const {
  double worst = 0.0;
  for (Eigen::Index i = 0; i < at_.loads.size(); ++i) {
    const double remaining = at_.approach[i] - at_.multiplier;
    worst = std::max(worst, at_.loads[i] > 0.0 ? std::abs(remaining) : -remaining);
  }
  const double carried = weight_.dot(at_.loads), balance = std::abs(carried - force_) / force_;
  // No point's scale exceeds this one, which takes one pass over the points instead of one over the matrix.
  const double largest_scale = largest_influence_ * carried + at_.local.maxCoeff();
  if (worst > reached * largest_scale) return std::max(balance, worst / largest_scale);
  return std::max(balance, worst / deflection_scale());
}

/// @returns whether the answer on the working set was reached
bool LoadSolver::newton(const LoadOptions& options, LoadDistribution& result) {
  for (;; ++result.iterations) {
    result.kkt_residual = residual(options.tolerance);
    if (result.kkt_residual <= options.tolerance && settled()) return true;
    if (result.iterations == options.max_iterations) {
      result.kkt_residual = residual(std::numeric_limits<double>::infinity());
      return false;
    }
    step();
    result.factorisations += model_.factorisations();
  }
}

void LoadSolver::step() {
  // Counted from the least approach, which is f_t at the answer and which no point far away has a part in.
  const double least = (at_.loads.array() > 0.0).select(at_.approach, at_.approach.maxCoeff()).minCoeff();
  gradient_ = weight_.cwiseProduct((at_.approach.array() - least).matrix());
  hessian_.diagonal() = stiff_diagonal_ + weight_.cwiseProduct(at_.local_slope);
  const Flags guess = at_.loads.array() > 0.0 || at_.approach.array() < at_.multiplier;
  model_.minimise({hessian_, gradient_, weight_, force_, at_.loads, least}, guess);
  next_.loads = model_.loads().cwiseMax(0.0);
  next_.loads *= force_ / weight_.dot(next_.loads);
  evaluate(next_);
  has_factor_ = true;

  // The approach is taken out of every term (a'd = 0 along a feasible step), so that the terms are as small as the
  // residual and not as large as the deflection.
  forces_ = weight_.cwiseProduct(next_.loads - at_.loads);
  const double slope_start = forces_.dot((at_.approach.array() - at_.multiplier).matrix());
  const double slope_end = forces_.dot((next_.approach.array() - at_.multiplier).matrix());
  // The whole step where it at least halves the slope, else to the minimum along it.
  if (slope_end > overshoot * std::abs(slope_start) && slope_start < 0.0) {
    const double t = bracketed_root([&](double s) { return slope_along(s); }, 0.0, slope_start, 1.0, slope_end, 1e-3).x;
    // A load that the whole step takes away goes where it is less than round-off of the others: what is left of it a step would never end.
    const double nothing = std::numeric_limits<double>::epsilon() * next_.loads.maxCoeff();
    const Eigen::VectorXd between = (at_.loads + t * (next_.loads - at_.loads)).cwiseMax(0.0);
    next_.loads = (next_.loads.array() == 0.0 && between.array() < nothing).select(0.0, between);
    evaluate(next_);
    has_factor_ = false;
  }
  load_step_ = (next_.loads - at_.loads).lpNorm<Eigen::Infinity>() / next_.loads.maxCoeff();
  std::swap(at_, next_);
}

/// The objective's slope at a share t of the way from one iterate to the next; all but the contact law is linear in t.
double LoadSolver::slope_along(double t) const {
  const auto between = [t](double start, double end) { return start + t * (end - start); };
  double sum = 0.0;
  for (Eigen::Index i = 0; i < forces_.size(); ++i) {
    const double linear = between(at_.approach[i] - at_.local[i], next_.approach[i] - next_.local[i]);
    const double load = std::max(0.0, between(at_.loads[i], next_.loads[i]));
    const double local = laws_.empty() ? 0.0 : laws_[static_cast<std::size_t>(i)]->deflection(load);
    sum += forces_[i] * (linear + local - at_.multiplier);
  }
  return sum;
}

/// Whether the loads are as accurate as the residual indicates, see `last_step`.
bool LoadSolver::settled() {
  if (laws_.empty() || load_step_ <= last_step) return true;
  if (!has_factor_) return false;
  Eigen::VectorXd remaining = weight_.cwiseProduct((at_.approach.array() - at_.multiplier).matrix())(model_.set());
  model_.factor().solve(remaining);
  return remaining.lpNorm<Eigen::Infinity>() <= last_correction * at_.loads.maxCoeff();
}

/// See LoadDistribution::condition.
double LoadSolver::condition() const {
  if (!has_factor_ || model_.factor().singular_pivots() > 0) return not_given;
  const std::vector<Eigen::Index>& set = model_.set();
  double norm = 0.0;
  for (const Eigen::Index j : set) {
    double sum = 0.0;
    for (const Eigen::Index i : set) sum += std::abs(hessian_(i, j));
    norm = std::max(norm, sum);
  }
  return norm * model_.factor().inverse_norm();
}

LoadSensitivity LoadSolver::sensitivity() const {
  std::vector<Eigen::Index> loaded, set;
  for (Eigen::Index i = 0; i < at_.loads.size(); ++i) {
    if (!(at_.loads[i] > 0.0)) continue;
    set.push_back(i);
    loaded.push_back(points_[static_cast<std::size_t>(i)]);
  }
  const Eigen::VectorXd diagonal = stiff_diagonal_ + weight_.cwiseProduct(at_.local_slope);
  const auto same_diagonal = [&] {
    return std::all_of(set.begin(), set.end(), [&](Eigen::Index i) { return std::abs(diagonal[i] - hessian_(i, i)) <= same_factor * diagonal[i]; });
  };
  if (has_factor_ && set == model_.set() && same_diagonal()) return {gap_.size(), loaded, weight_(set), model_.factor()};
  Cholesky factor;
  Eigen::MatrixXd& rows = factor.prepare(std::ssize(set));
  rows = hessian_(set, set);
  rows.diagonal() = diagonal(set);
  factor.factorise();
  return {gap_.size(), std::move(loaded), weight_(set), std::move(factor)};
}

LoadDistribution solve_load_distribution(const LoadProblemView& problem, const LoadOptions& options, const Eigen::VectorXd& start) {
  return LoadSolver().solve(problem, options, start);
}

}  // namespace flankwright
