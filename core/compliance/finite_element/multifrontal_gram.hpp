#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>

#include "core/base/for_each_index.hpp"
#include "core/compliance/finite_element/elimination_order.hpp"
#include "core/compliance/finite_element/sparse_cholesky.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// B' A^-1 B and what it took.
struct MultifrontalGram {
  FactorStatus status{FactorStatus::NotPositiveDefinite};
  Eigen::MatrixXd gram;                ///< k x k, exactly symmetric; empty unless status is Factorised
  double factor_entries{not_given};    ///< of L, with the zeros of its dense blocks
  double peak_bytes{not_given};        ///< held at most, known before the first number is computed
  double analysis_seconds{not_given};  ///< wall time until then
};

/// Progress of an elimination: the part of its operations that is done, 0 .. 1.
using EliminationProgress = std::function<void(double)>;

/// B' A^-1 B of a sparse B without a factor that is kept, by a multifrontal elimination [Duff and Reid, The multifrontal
/// solution of indefinite sparse symmetric linear equations, ACM TOMS 9 (1983)]. With the supernodes of SymbolicFactor,
/// upwards,
///
///     F_s = A_s + sum of U_c over the children c,    F_s = [L_ss; L_ts] [..]' + U_s,
///
/// a block of L lives until SupernodalGram has taken it, and U_s until its parent has. These updates wait on a stack, which takes
/// a fraction of the whole factor's memory. The operations are those of SparseCholesky and SparseCholesky::gram(), in another order:
/// equal to round-off.
///
/// Same input, same bits, whatever the number of threads.
/// @param lower, node_of  as SparseCholesky; the matrix is taken() and freed as soon as it is ordered
/// @param right_sides     B, n x k
/// @param memory_limit    OutOfMemory where peak_bytes > memory_limit [bytes], before the elimination, and where an allocation fails
/// @param for_each        shares panels of large blocks among threads, PanelProducts; empty: all on the calling thread
/// @param order           of the same matrix; not made: it is made here
MultifrontalGram multifrontal_gram(Eigen::SparseMatrix<double>&& lower, const Eigen::VectorXi& node_of,
                                   const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides, double memory_limit,
                                   const EliminationProgress& progress = {}, const ForEachIndex& for_each = {}, EliminationOrder order = {});

}  // namespace flankwright
