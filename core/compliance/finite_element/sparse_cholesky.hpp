#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <memory>

namespace flankwright {

/// Outcome of a factorisation.
enum class FactorStatus {
  Factorised,
  NotPositiveDefinite,  ///< smallest over largest pivot at most smallest_pivot: supports leave a motion free
  OutOfMemory,
};

/// Smallest over largest pivot [-]. Pivots left by the elimination of a rigid motion are round-off, 1e-16 of the largest one
/// times a few powers of ten; those of a gear that is held stay above 1e-9.
inline constexpr double smallest_pivot = 1e-13;

/// Supernodal Cholesky factor P A P' = L L' of a sparse matrix of 3 x 3 node blocks (SuiteSparse CHOLMOD), ordered by
/// METIS on the graph of the nodes. Factorised once, used for any number of right-hand sides.
///
/// Same input, same bits: where BLAS is OpenBLAS, its own threads are switched off for the calls made here (they would
/// split sums by the number of cores), and so are CHOLMOD's by OpenMP, so that the cost is that of one core. With reference BLAS a model took five
/// times as long at 50,000 unknowns.
class SparseCholesky {
 public:
  /// @param lower     n x n, lower triangle only, compressed
  /// @param node_of   node of every row, size n, ascending: rows of one node stay together in the ordering
  SparseCholesky(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXi& node_of);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  FactorStatus status() const { return status_; }
  std::size_t factor_entries() const;  ///< stored entries of L, with the zeros of its dense blocks
  std::size_t peak_bytes() const;      ///< largest memory that CHOLMOD held

  /// A^-1 B, n x k. Needs status() Factorised.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_sides) const;
  /// B' A^-1 B, k x k, exactly symmetric, see SupernodalGram. Needs status() Factorised.
  Eigen::MatrixXd gram(const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  FactorStatus status_;
};

}  // namespace flankwright
