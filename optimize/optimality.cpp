#include "optimize/optimality.hpp"

#include <Eigen/QR>
#include <algorithm>

namespace flankwright {

namespace {

constexpr double felt = 1e-6;  // a multiplier that counts is above it

/// A row or bound near enough to be active.
struct Near {
  ActiveBound bound;
  double slack;              ///< c <= 0
  Eigen::VectorXd gradient;  ///< over all of y
};

std::vector<Near> near_rows(const EpigraphProgram& program, const ProgramValues& values, const Eigen::VectorXd& y, int design_variables) {
  std::vector<Near> near;
  for (int r = 0; r < program.constraints(); ++r) {
    if (values.constraints[r] < -Optimality::reach) continue;
    near.push_back({{program.rows()[static_cast<std::size_t>(r)]}, values.constraints[r], values.constraint_jacobian.row(r)});
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
      near.push_back({bound, slack, side * Eigen::VectorXd::Unit(program.variables(), i)});
    }
  }
  return near;
}

/// minimise |A lambda - b| over lambda >= 0 [Lawson, Hanson, Solving Least Squares Problems (1974), ch. 23].
Eigen::VectorXd nonnegative_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::Index n = A.cols();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> passive;
  // Each step lowers the residual, so that no passive set comes twice; the limit is for round-off.
  for (Eigen::Index step = 0; step < 3 * n + 10; ++step) {
    Eigen::VectorXd gain = A.transpose() * (b - A * x);
    for (Eigen::Index i : passive) gain[i] = -1.0;
    Eigen::Index next = 0;
    constexpr double round_off = 1e-12;  // gain <= round_off |A_i| |b| is none
    if (n == 0 || gain.maxCoeff(&next) <= round_off * A.col(next).norm() * b.norm()) break;
    passive.push_back(next);
    bool inside = false;
    while (!inside && !passive.empty()) {
      const Eigen::VectorXd z = A(Eigen::all, passive).completeOrthogonalDecomposition().solve(b);
      // As far towards the unconstrained minimum as no multiplier passes below 0.
      double share = 1.0;
      std::size_t first = passive.size();
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double at = x[passive[k]], to = z[static_cast<Eigen::Index>(k)];
        if (to > 0.0 || at / (at - to) >= share) continue;
        share = at / (at - to);
        first = k;
      }
      for (std::size_t k = 0; k < passive.size(); ++k) x[passive[k]] += share * (z[static_cast<Eigen::Index>(k)] - x[passive[k]]);
      inside = first == passive.size();
      if (inside) break;
      x[passive[first]] = 0.0;
      passive.erase(passive.begin() + static_cast<std::ptrdiff_t>(first));
    }
    if (std::find(passive.begin(), passive.end(), next) == passive.end()) break;  // its gain was round-off
  }
  return x;
}

}  // namespace

Optimality first_order_optimality(DesignProblem& problem, const Eigen::VectorXd& x) {
  DesignLog log(nullptr);
  EpigraphProgram program(problem, log);
  program.add_candidates(x);
  program.restart_from(x);
  const Eigen::VectorXd y = program.start();
  const ProgramValues values = program.evaluate(y, true);
  const std::vector<Near> near = near_rows(program, values, y, problem.variables());
  const auto n = static_cast<Eigen::Index>(program.variables()), m = static_cast<Eigen::Index>(near.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, m);
  for (Eigen::Index j = 0; j < m; ++j) {
    A.col(j).head(n) = near[static_cast<std::size_t>(j)].gradient;
    A(n + j, j) = near[static_cast<std::size_t>(j)].slack;
  }
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + m);
  b.head(n) = -values.objective_gradient;
  const Eigen::VectorXd lambda = nonnegative_solution(A, b);
  const Eigen::VectorXd left = (A * lambda - b).cwiseAbs();
  Optimality result;
  result.residual = left.head(n).maxCoeff();
  result.complementarity = m == 0 ? 0.0 : left.tail(m).maxCoeff();
  for (Eigen::Index j = 0; j < m; ++j) {
    if (lambda[j] <= felt) continue;
    result.active.push_back(near[static_cast<std::size_t>(j)].bound);
    result.active.back().multiplier = lambda[j];
  }
  std::stable_sort(result.active.begin(), result.active.end(),
                   [](const ActiveBound& a, const ActiveBound& c) { return a.multiplier > c.multiplier; });
  return result;
}

}  // namespace flankwright
