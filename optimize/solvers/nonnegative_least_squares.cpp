#include "optimize/solvers/nonnegative_least_squares.hpp"

#include <Eigen/Jacobi>
#include <algorithm>
#include <cassert>
#include <limits>
#include <vector>

namespace flankwright {

namespace {

/// Q R of the columns that are in, (a_j, s_j e_j), updated as columns enter and leave: a factorisation anew costs as many times more as there are columns.
class ColumnFactor {
 public:
  /// @param A     m x n
  /// @param pull  s, n
  ColumnFactor(const Eigen::MatrixXd& A, const Eigen::VectorXd& pull) : A_(A), pull_(pull), Q_(A.rows(), 0) {}

  const std::vector<Eigen::Index>& columns() const { return in_; }

  /// @returns false where the column depends on those that are in; it stays out
  bool add(Eigen::Index column) {
    const Eigen::Index count = std::ssize(in_), row = free_row();
    Eigen::VectorXd rest = Eigen::VectorXd::Zero(Q_.rows()), on_others = Eigen::VectorXd::Zero(count);
    rest.head(A_.rows()) = A_.col(column);
    rest[row] = pull_[column];
    const double length = rest.norm();
    for (int twice = 0; twice < 2; ++twice) {  // Gram-Schmidt is orthogonal to round-off the second time
      const Eigen::VectorXd share = Q_.leftCols(count).transpose() * rest;
      rest.noalias() -= Q_.leftCols(count) * share;
      on_others += share;
    }
    const double own = rest.norm();
    if (own <= dependent * length) return false;
    if (Q_.cols() == count) {
      Q_.conservativeResize(Eigen::NoChange, 2 * count + 1);
      R_.conservativeResize(2 * count + 1, 2 * count + 1);
    }
    Q_.col(count) = rest / own;
    R_.col(count).head(count) = on_others;
    R_(count, count) = own;
    in_.push_back(column);
    row_of_.push_back(row);
    return true;
  }

  /// Givens' rotations make R triangular again [Golub & Van Loan, Matrix Computations, 3rd edition 1996, section 12.5].
  void remove(std::size_t place) {
    const Eigen::Index count = std::ssize(in_), last = count - 1;
    for (auto k = static_cast<Eigen::Index>(place); k < last; ++k) {
      R_.col(k).head(k + 2) = R_.col(k + 1).head(k + 2);
      Eigen::JacobiRotation<double> turn;
      turn.makeGivens(R_(k, k), R_(k + 1, k));
      R_.col(k).head(k + 2).applyOnTheLeft(k, k + 1, turn.adjoint());
      R_.block(0, k + 2, k + 2, last - k - 1).applyOnTheLeft(k, k + 1, turn.adjoint());
      Q_.applyOnTheRight(k, k + 1, turn);
    }
    Q_.row(row_of_[place]).setZero();
    in_.erase(in_.begin() + static_cast<std::ptrdiff_t>(place));
    row_of_.erase(row_of_.begin() + static_cast<std::ptrdiff_t>(place));
  }

  /// Least squares over the columns that are in; zero elsewhere.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    const Eigen::Index count = std::ssize(in_);
    Eigen::VectorXd found = Q_.topLeftCorner(A_.rows(), count).transpose() * b;
    R_.topLeftCorner(count, count).triangularView<Eigen::Upper>().solveInPlace(found);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(A_.cols());
    y(in_) = found;
    return y;
  }

 private:
  /// A column depends on others where no more than this part of it stands at right angles to them: round-off.
  static constexpr double dependent = 1e-13;

  /// A row below A that no column in has its s_j in.
  Eigen::Index free_row() {
    Eigen::Index row = A_.rows();
    while (std::ranges::find(row_of_, row) != row_of_.end()) ++row;
    if (row == Q_.rows()) {
      Q_.conservativeResize(2 * row + 1, Eigen::NoChange);
      Q_.bottomRows(row + 1).setZero();
    }
    return row;
  }

  const Eigen::MatrixXd& A_;
  const Eigen::VectorXd& pull_;
  Eigen::MatrixXd Q_, R_;                  ///< room for more columns than are in
  std::vector<Eigen::Index> in_, row_of_;  ///< the columns; the row of Q that each has its s_j in
};

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
  ColumnFactor factor(A, pull);
  const std::vector<Eigen::Index>& in = factor.columns();
  // Progress is a sum of squares that falls by more than this part of |b|^2, its round-off. Columns that nearly depend on each other
  // would otherwise enter and leave in turn.
  constexpr double progress = 1e-15;
  double lowest = std::numeric_limits<double>::infinity();
  std::vector<bool> barred(static_cast<std::size_t>(A.cols()), false);  // has entered since the last progress
  const Eigen::Index most_steps = 10 * A.cols() + 10;                   // Lawson and Hanson met 3 n at most
  for (Eigen::Index step = 0; step < most_steps; ++step) {
    const Eigen::VectorXd rest = b - A * y;
    const double squares = rest.squaredNorm() + pull.cwiseProduct(y).squaredNorm();
    if (squares < lowest - progress * b.squaredNorm()) {
      lowest = squares;
      std::fill(barred.begin(), barred.end(), false);
    }
    const Eigen::VectorXd slope = A.transpose() * rest - pull.cwiseAbs2().cwiseProduct(y);
    std::vector<bool> is_out(static_cast<std::size_t>(A.cols()), true);
    for (const Eigen::Index j : in) is_out[static_cast<std::size_t>(j)] = false;
    Eigen::Index entering = -1;
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const bool may_enter = is_out[static_cast<std::size_t>(j)] && !barred[static_cast<std::size_t>(j)] && slope[j] > least[j];
      if (may_enter && (entering < 0 || slope[j] > slope[entering])) entering = j;
    }
    if (entering < 0) return y;
    barred[static_cast<std::size_t>(entering)] = true;
    const bool independent = factor.add(entering);
    Eigen::VectorXd z = factor.solve(b);
    if (!independent || z[entering] <= 0.0) {  // depends on those that are in
      if (independent) factor.remove(in.size() - 1);
      continue;
    }
    const auto negative = [&](Eigen::Index j) { return z[j] <= 0.0; };
    while (std::any_of(in.begin(), in.end(), negative)) {
      double share = 1.0;  // of the way to z before the first turns negative
      for (const Eigen::Index j : in) {
        if (z[j] <= 0.0) share = std::min(share, y[j] / (y[j] - z[j]));
      }
      y += share * (z - y);
      const double smallest = descent * y.lpNorm<Eigen::Infinity>();
      for (std::size_t k = in.size(); k-- > 0;) {
        if (z[in[k]] <= 0.0 && y[in[k]] <= smallest) factor.remove(k);
      }
      z = factor.solve(b);
    }
    y = z;
  }
  return y;
}

}  // namespace flankwright
