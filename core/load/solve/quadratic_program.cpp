#include "core/load/solve/quadratic_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flankwright {

namespace {

/// Block steps without progress before the primal method; the authors suggest as many before single pivots.
constexpr int block_patience = 3;
/// A slack counts as negative below -round_off * (sum of the magnitudes of its terms).
constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon();

/// Loads are refined by what they leave of the linear system where |a'x - F| > balance * F: where H is nearly singular the first solution
/// loses digits between large terms.
constexpr double balance = 1e-14;

}  // namespace

bool QuadraticProgram::minimise(const QuadraticProblem& problem, const Flags& guess) {
  const Eigen::Index size = problem.x.size();
  factorisations_ = 0;
  Flags loaded = guess;
  if (!loaded.any()) loaded.setConstant(true);
  Eigen::Index fewest = size + 1;
  for (int patience = block_patience; patience >= 0;) {
    balance_on(problem, loaded);
    find_slacks(problem);
    // Violated: negative load in the set, negative slack outside.
    const Flags violated = loaded.select(loads_.array() < 0.0, slack_.array() < 0.0);
    const Eigen::Index count = violated.count();
    if (count == 0) return true;
    patience = count < fewest ? block_patience : patience - 1;
    fewest = std::min(fewest, count);
    loaded = loaded != violated;
    if (!loaded.any()) break;  // all loads negative: round-off of a nearly singular H
  }
  return descend(problem);
}

/// From the loads of the last set, without the negative ones, down to the minimum: towards the minimiser on the
/// loaded set up to the first load that vanishes, which leaves the set; at the minimiser the point that would
/// penetrate most joins it.
bool QuadraticProgram::descend(const QuadraticProblem& problem) {
  const Eigen::Index size = problem.x.size();
  Eigen::VectorXd x = loads_.cwiseMax(0.0);
  x *= problem.F / problem.a.dot(x);
  Flags loaded = x.array() > 0.0;
  Eigen::Index joined = -1;
  for (Eigen::Index step = 0; step < 20 * size + 100; ++step) {
    balance_on(problem, loaded);
    double length = 1.0;
    for (Eigen::Index i = 0; i < size; ++i) {
      if (loaded[i] && loads_[i] < 0.0) length = std::min(length, x[i] / (x[i] - loads_[i]));
    }
    if (length == 1.0) {
      x = loads_;
      joined = most_penetrating(problem, loaded);
      if (joined < 0) return true;
      loaded[joined] = true;
      continue;
    }
    for (Eigen::Index i = 0; i < size; ++i) {
      if (!loaded[i]) continue;
      const double target = loads_[i];
      const bool vanishes = target < 0.0 && x[i] / (x[i] - target) <= length;
      x[i] = vanishes ? 0.0 : x[i] + length * (target - x[i]);
      loaded[i] = !vanishes;
    }
    // The point that has just joined would take no load: its slack was round-off.
    if (joined >= 0 && !loaded[joined] && length == 0.0) {
      balance_on(problem, loaded);
      if ((loads_.array() >= 0.0).all()) return true;
    }
  }
  loads_ = x;
  return false;
}

/// Loads on a set that balance the force, signs free; none outside.
void QuadraticProgram::balance_on(const QuadraticProblem& problem, const Flags& loaded) {
  const auto& [H, g, a, F, x, terms] = problem;
  const Eigen::Index size = x.size();
  set_.clear();
  double missing = F;
  bool leaves = false;  // a load goes that was there
  for (Eigen::Index i = 0; i < size; ++i) {
    if (loaded[i]) {
      set_.push_back(i);
      missing -= a[i] * x[i];
    } else {
      leaves = leaves || x[i] != 0.0;
    }
  }
  right_ = g;
  if (leaves) right_ -= H * loaded.select(0.0, x.array()).matrix();
  const Eigen::Index n = std::ssize(set_);
  Eigen::MatrixXd& rows = factor_.prepare(n, 2);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::Index column = set_[static_cast<std::size_t>(j)];
    if (n == size) {
      rows.col(j).segment(j, n - j) = H.col(j).tail(n - j);
    } else {
      const double* from = H.data() + column * size;
      double* to = rows.data() + j * rows.rows();
      for (Eigen::Index i = j; i < n; ++i) to[i] = from[set_[static_cast<std::size_t>(i)]];
    }
    rows(n, j) = a[column];
    rows(n + 1, j) = right_[column];
  }
  factor_.factorise();
  ++factorisations_;
  // d = H^-1 (multiplier a - right), and a'd is what is missing.
  const auto by_weight = factor_.carried(0), by_right = factor_.carried(1);
  multiplier_ = (missing + by_weight.dot(by_right)) / by_weight.squaredNorm();
  slack_ = (multiplier_ * by_weight - by_right).transpose();
  factor_.solve_transposed(slack_);
  step_ = -x;
  loads_ = Eigen::VectorXd::Zero(size);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::Index i = set_[static_cast<std::size_t>(j)];
    step_[i] = slack_[j];
    loads_[i] = x[i] + slack_[j];
  }
  const double unbalanced = F - a.dot(loads_);
  if (std::abs(unbalanced) > balance * F) refine(problem, unbalanced);
}

void QuadraticProgram::refine(const QuadraticProblem& problem, double unbalanced) {
  const Eigen::VectorXd by_set = problem.a(set_);
  Eigen::VectorXd left = (problem.H * step_ + problem.g - multiplier_ * problem.a)(set_), response = by_set;
  factor_.solve(left);
  factor_.solve(response);
  const double rise = (unbalanced + by_set.dot(left)) / by_set.dot(response);
  const Eigen::VectorXd change = rise * response - left;
  multiplier_ += rise;
  step_(set_) += change;
  loads_(set_) += change;
}

/// Of all points; those in the set have none but round-off.
void QuadraticProgram::find_slacks(const QuadraticProblem& problem) {
  if (std::ssize(set_) == problem.x.size()) {
    slack_.setZero(problem.x.size());
    return;
  }
  slack_ = problem.g - multiplier_ * problem.a;
  slack_.noalias() += problem.H * step_;
}

/// The unloaded point of the largest negative slack per length, -1 where there is none.
Eigen::Index QuadraticProgram::most_penetrating(const QuadraticProblem& problem, const Flags& loaded) {
  find_slacks(problem);
  const Eigen::VectorXd terms =
      problem.H.cwiseAbs() * (loads_ + step_.cwiseAbs()) + problem.g.cwiseAbs() + (problem.terms + std::abs(multiplier_)) * problem.a;
  Eigen::Index worst = -1;
  for (Eigen::Index i = 0; i < problem.x.size(); ++i) {
    if (loaded[i] || slack_[i] >= -round_off * terms[i]) continue;
    if (worst < 0 || slack_[i] * problem.a[worst] < slack_[worst] * problem.a[i]) worst = i;
  }
  return worst;
}

}  // namespace flankwright
