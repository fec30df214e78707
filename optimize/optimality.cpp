#include "optimize/optimality.hpp"

#include <algorithm>

#include "optimize/nonnegative_least_squares.hpp"

namespace flankwright {

namespace {

/// Up to what is left over the conditions count as holding without the bounds of the variables, as DesignResult::optimal.
constexpr double holds = 1e-4;

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
    ActiveBound bound{program.rows()[static_cast<std::size_t>(r)]};
    bound.by_output = program.by_output(bound.row);
    near.push_back({bound, values.constraints[r], values.constraint_jacobian.row(r)});
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
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, m), free = A;  // free: without the bounds of the variables
  for (Eigen::Index j = 0; j < m; ++j) {
    A.col(j).head(n) = near[static_cast<std::size_t>(j)].gradient;
    A(n + j, j) = near[static_cast<std::size_t>(j)].slack;
    if (near[static_cast<std::size_t>(j)].bound.variable < 0) free.col(j) = A.col(j);
  }
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + m);
  b.head(n) = -values.objective_gradient;
  Eigen::VectorXd lambda = nonnegative_least_squares(free, b);
  if ((free * lambda - b).lpNorm<Eigen::Infinity>() > holds) lambda = nonnegative_least_squares(A, b);
  const Eigen::VectorXd left = (A * lambda - b).cwiseAbs();
  Optimality result;
  result.objective_scale = program.objective_scale();
  result.residual = left.head(n).maxCoeff();
  result.complementarity = m == 0 ? 0.0 : left.tail(m).maxCoeff();
  for (Eigen::Index j = 0; j < m; ++j) {
    if (lambda[j] <= Optimality::felt) continue;
    result.active.push_back(near[static_cast<std::size_t>(j)].bound);
    result.active.back().multiplier = lambda[j];
  }
  std::stable_sort(result.active.begin(), result.active.end(),
                   [](const ActiveBound& a, const ActiveBound& c) { return a.multiplier > c.multiplier; });
  return result;
}

}  // namespace flankwright
