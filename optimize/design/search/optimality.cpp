#include "optimize/design/search/optimality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "optimize/solvers/nonnegative_least_squares.hpp"

namespace flankwright {

namespace {

/// A gradient that changes by more than this share within the neighbourhood has a kink in it: of smooth rows it changes by some 1e-4.
constexpr double kink_share = 1e-3;

/// A row or bound near enough to be active, with one of its gradients.
struct Near {
  ActiveBound bound;
  int row;                   ///< of the programme, -1 for a bound of a variable
  double slack;              ///< c <= 0 at the design itself
  Eigen::VectorXd gradient;  ///< over all of y
  bool bends{false};         ///< the gradient of a neighbour, another by more than curvature explains
};

std::vector<Near> near_rows(const EpigraphProgram& program, const ProgramValues& values, const Eigen::VectorXd& y, int design_variables) {
  std::vector<Near> near;
  // Peaks are counted in those of the start, which may be many times as high: near is what is near to the objective as it is now.
  const double below_peak = Optimality::reach * std::min(1.0, std::abs(values.objective));
  for (int r = 0; r < program.constraints(); ++r) {
    ActiveBound bound{program.rows()[static_cast<std::size_t>(r)]};
    const bool is_peak = bound.row.kind == EpigraphRow::Kind::Floor || bound.row.kind == EpigraphRow::Kind::Ceiling;
    if (values.constraints[r] < -(is_peak ? below_peak : Optimality::reach)) continue;
    bound.by_output = program.by_output()[static_cast<std::size_t>(r)];
    near.push_back({bound, r, values.constraints[r], values.constraint_jacobian.row(r)});
  }
  const Eigen::VectorXd lower = program.lower(), upper = program.upper();
  for (int i = 0; i < program.variables(); ++i) {
    for (const int side : {-1, 1}) {
      const double slack = side < 0 ? lower[i] - y[i] : y[i] - upper[i];
      if (slack < -Optimality::reach) continue;
      ActiveBound bound;
      if (i < design_variables) {
        bound.variable = i;
        bound.side = side;
      }
      near.push_back({bound, -1, slack, side * Eigen::VectorXd::Unit(program.variables(), i)});
    }
  }
  return near;
}

/// Adds the gradients that near rows have at neighbours of y along each design variable, where they are others.
void add_neighbours(EpigraphProgram& program, const Eigen::VectorXd& y, int design_variables, std::vector<Near>& near) {
  const std::size_t own = near.size();
  for (int i = 0; i < design_variables; ++i) {
    for (const double step : {-Optimality::neighbourhood, Optimality::neighbourhood}) {
      Eigen::VectorXd beside = y;
      beside[i] += step;
      if (beside[i] < 0.0 || beside[i] > 1.0) continue;
      ProgramValues values;
      try {
        values = program.evaluate(beside, true);
      } catch (const std::runtime_error&) {
        continue;  // cannot be analysed: no gradient from there
      }
      for (std::size_t j = 0; j < own; ++j) {
        if (near[j].row < 0) continue;
        const Eigen::VectorXd gradient = values.constraint_jacobian.row(near[j].row);
        const double change = (gradient - near[j].gradient).lpNorm<Eigen::Infinity>();
        if (change <= Optimality::holds) continue;
        const bool bends = change > kink_share * near[j].gradient.lpNorm<Eigen::Infinity>();
        near.push_back({near[j].bound, near[j].row, near[j].slack, gradient, bends});
      }
    }
  }
}

/// Whether a row or a bound of a variable is a limit of the task, and not a peak or a part of how the programme is written.
bool is_limit(const ActiveBound& bound) {
  using enum EpigraphRow::Kind;
  return bound.variable >= 0 || bound.row.kind == OutputBound || bound.row.kind == ObjectiveBound || bound.row.kind == ModificationBound;
}

/// Which rows may have a multiplier: all but the limits that no design is at whose variables differ by at most a share of their ranges, to first order.
std::vector<bool> rows_within(const std::vector<Near>& near, double share) {
  std::vector<bool> within;
  for (const Near& row : near) within.push_back(!is_limit(row.bound) || -row.slack <= share * row.gradient.lpNorm<1>() + DesignLog::tolerance);
  return within;
}

/// The multipliers that balance best among those of some rows; rows of several gradients count once in `active`.
Optimality balance_of(const std::vector<Near>& near, const std::vector<bool>& takes_part, const Eigen::VectorXd& objective_gradient,
                      int design_variables) {
  const Eigen::Index n = objective_gradient.size();
  const auto m = static_cast<Eigen::Index>(near.size());
  // Least squares of what is left of the gradient and of each multiplier times its slack; rows that take no part are 0.
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, m), free = A;  // free: without the bounds of the variables
  Eigen::VectorXd slack = Eigen::VectorXd::Zero(m), free_slack = slack;
  for (Eigen::Index j = 0; j < m; ++j) {
    const auto at = static_cast<std::size_t>(j);
    if (!takes_part[at]) continue;
    A.col(j) = near[at].gradient;
    slack[j] = near[at].slack;
    if (near[at].bound.variable >= 0) continue;
    free.col(j) = A.col(j);
    free_slack[j] = slack[j];
  }
  const Eigen::VectorXd b = -objective_gradient;
  const auto left = [&](const Eigen::VectorXd& lambda) { return (A * lambda - b).lpNorm<Eigen::Infinity>(); };
  const auto beside = [&](const Eigen::VectorXd& lambda) { return m == 0 ? 0.0 : slack.cwiseProduct(lambda).lpNorm<Eigen::Infinity>(); };
  Eigen::VectorXd lambda = nonnegative_least_squares(free, b, free_slack);
  if (std::max(left(lambda), beside(lambda)) > Optimality::holds) lambda = nonnegative_least_squares(A, b, slack);
  Optimality result;
  result.residual = left(lambda);
  result.complementarity = beside(lambda);
  result.steepest = Eigen::VectorXd::Zero(design_variables);
  std::map<int, std::size_t> place;  // of a programme's row in `active`
  for (Eigen::Index j = 0; j < m; ++j) {
    if (lambda[j] <= Optimality::felt) continue;
    const Near& row = near[static_cast<std::size_t>(j)];
    const auto [at, is_new] = place.try_emplace(row.row < 0 ? -1 - static_cast<int>(j) : row.row, result.active.size());
    if (is_new) result.active.push_back(row.bound);
    result.steepest = result.steepest.cwiseMax(row.gradient.head(design_variables).cwiseAbs());
    ActiveBound& bound = result.active[at->second];
    bound.multiplier += lambda[j];
    bound.is_kink = bound.is_kink || row.bends;
  }
  std::stable_sort(result.active.begin(), result.active.end(),
                   [](const ActiveBound& a, const ActiveBound& c) { return a.multiplier > c.multiplier; });
  return result;
}

/// The multipliers that balance best with the limits of the smallest neighbourhood in which the conditions hold; with all where they hold in none.
Optimality balance(const std::vector<Near>& near, const Eigen::VectorXd& objective_gradient, int design_variables) {
  constexpr std::array shares{Optimality::neighbourhood, 10.0 * Optimality::neighbourhood, 100.0 * Optimality::neighbourhood};
  std::vector<bool> tried;
  for (const double share : shares) {
    std::vector<bool> within = rows_within(near, share);
    if (within == tried) continue;
    if (Optimality result = balance_of(near, within, objective_gradient, design_variables); result.satisfied()) return result;
    tried = std::move(within);
  }
  return balance_of(near, std::vector<bool>(near.size(), true), objective_gradient, design_variables);
}

}  // namespace

Optimality first_order_optimality(DesignProblem& problem, const Eigen::VectorXd& x) {
  DesignLog log(nullptr);
  EpigraphProgram program(problem, log);
  program.add_candidates(x);
  program.restart_from(x);
  const Eigen::VectorXd y = program.start();
  const ProgramValues values = program.evaluate(y, true);
  std::vector<Near> near = near_rows(program, values, y, problem.variables());
  Optimality result = balance(near, values.objective_gradient, problem.variables());
  if (!result.satisfied()) {
    add_neighbours(program, y, problem.variables(), near);
    if (Optimality on_kink = balance(near, values.objective_gradient, problem.variables()); on_kink.satisfied()) result = std::move(on_kink);
  }
  result.objective_scale = program.objective_of(values.objective).by;
  return result;
}

}  // namespace flankwright
