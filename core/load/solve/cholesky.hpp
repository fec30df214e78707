#pragma once

#include <Eigen/Core>

namespace flankwright {

/// Cholesky factor H = L L' of a symmetric positive definite matrix of up to a few hundred rows, in memory that it keeps.
///
/// Rows below the matrix are right-hand sides that are carried along: the factorisation leaves L^-1 b in them. Four columns are
/// eliminated at a time, which at this size takes half the time of Eigen's LLT.
class Cholesky {
 public:
  /// A pivot of no more than this fraction of its diagonal entry is round-off: the matrix is singular there. The unknown is held at 0,
  /// which solves a consistent system.
  static constexpr double least_pivot = 2.2e-16;

  /// The storage of factorise(): (n + carried) x n, contents unspecified. The caller fills the lower triangle of the
  /// first n rows with H and the rows below with right-hand sides; values above the diagonal are not read.
  Eigen::MatrixXd& prepare(Eigen::Index n, Eigen::Index carried = 0);
  void factorise();

  Eigen::Index size() const { return rows_.cols(); }
  /// Unknowns held at 0.
  int singular_pivots() const { return singular_; }
  /// L^-1 b of the k-th row carried along, 1 x n.
  auto carried(Eigen::Index k) const { return rows_.row(size() + k); }

  /// Replaces the columns of y, n x m, by L'^-1 y.
  template <class Matrix>
  void solve_transposed(Matrix& y) const {
    square().transpose().template triangularView<Eigen::Upper>().solveInPlace(y);
  }
  /// Replaces the columns of b, n x m, by H^-1 b.
  template <class Matrix>
  void solve(Matrix& b) const {
    square().template triangularView<Eigen::Lower>().solveInPlace(b);
    solve_transposed(b);
  }
  /// Lower bound of ||H^-1||_1, seldom less than a third of it, by a handful of solutions (Higham 1988, algorithm 4.1).
  double inverse_norm() const;

 private:
  auto square() const { return rows_.topRows(size()); }
  double pivot(double left, Eigen::Index column);

  Eigen::MatrixXd rows_;
  Eigen::VectorXd diagonal_;  ///< of H
  int singular_{0};
};

}  // namespace flankwright
