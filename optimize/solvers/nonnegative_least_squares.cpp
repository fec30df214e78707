#include "optimize/solvers/nonnegative_least_squares.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <vector>

namespace flankwright {

namespace {

/// Least squares over the columns that are in; zero elsewhere.
Eigen::VectorXd solve_over(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& pull, const std::vector<Eigen::Index>& in) {
  const Eigen::Index rows = A.rows(), columns = std::ssize(in);
  Eigen::MatrixXd of_in = Eigen::MatrixXd::Zero(rows + columns, columns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(rows + columns);
  of_in.topRows(rows) = A(Eigen::all, in);
  of_in.bottomRows(columns).diagonal() = pull(in);
  right.head(rows) = b;
  const Eigen::VectorXd found = of_in.completeOrthogonalDecomposition().solve(right);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(A.cols());
  for (std::size_t k = 0; k < in.size(); ++k) y[in[k]] = found[static_cast<Eigen::Index>(k)];
  return y;
}

}  // namespace

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return nonnegative_least_squares(A, b, Eigen::VectorXd::Zero(A.cols()));
}

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& pull) {
  assert(b.size() == A.rows() && pull.size() == A.cols());
  Eigen::VectorXd y = Eigen::VectorXd::Zero(A.cols());
  if (A.cols() == 0 || A.rows() == 0) return y;
  // A column may enter where a_j . r - s_j^2 y_j > descent |(a_j, s_j)| |b|: smaller values are round-off.
  constexpr double descent = 1e-12;
  const Eigen::VectorXd least = descent * b.norm() * (A.colwise().squaredNorm().transpose() + pull.cwiseAbs2()).cwiseSqrt();
  std::vector<Eigen::Index> in;
  std::vector<bool> barred(static_cast<std::size_t>(A.cols()), false);  // entered in vain; free again after any progress
  const Eigen::Index most_steps = 10 * A.cols() + 10;                   // Lawson and Hanson met 3 n at most
  for (Eigen::Index step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd slope = A.transpose() * (b - A * y) - pull.cwiseAbs2().cwiseProduct(y);
    Eigen::Index entering = -1;
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const bool is_in = std::find(in.begin(), in.end(), j) != in.end();
      if (is_in || barred[static_cast<std::size_t>(j)] || slope[j] <= least[j]) continue;
      if (entering < 0 || slope[j] > slope[entering]) entering = j;
    }
    if (entering < 0) return y;
    in.push_back(entering);
    Eigen::VectorXd z = solve_over(A, b, pull, in);
    if (z[entering] <= 0.0) {  // depends on those that are in
      in.pop_back();
      barred[static_cast<std::size_t>(entering)] = true;
      continue;
    }
    std::fill(barred.begin(), barred.end(), false);
    const auto negative = [&](Eigen::Index j) { return z[j] <= 0.0; };
    while (std::any_of(in.begin(), in.end(), negative)) {
      double share = 1.0;  // of the way to z before the first turns negative
      for (const Eigen::Index j : in) {
        if (z[j] <= 0.0) share = std::min(share, y[j] / (y[j] - z[j]));
      }
      y += share * (z - y);
      const double smallest = descent * y.lpNorm<Eigen::Infinity>();
      std::erase_if(in, [&](Eigen::Index j) { return z[j] <= 0.0 && y[j] <= smallest; });
      z = solve_over(A, b, pull, in);
    }
    y = z;
  }
  return y;
}

}  // namespace flankwright
