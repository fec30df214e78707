#pragma once

#include <cholmod.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace flankwright {

/// The pattern of the supernodal Cholesky factor P A P' = L L' of a sparse matrix of node blocks, by CHOLMOD, ordered by
/// METIS on the graph of the nodes. The factor has no numbers yet.
struct SymbolicFactor {
  cholmod_common common;
  cholmod_factor* l{nullptr};  ///< null where memory did not suffice

  /// @param lower, node_of  as SparseCholesky; keep OneCore while this runs
  SymbolicFactor(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXi& node_of);
  ~SymbolicFactor();
  SymbolicFactor(const SymbolicFactor&) = delete;
  SymbolicFactor& operator=(const SymbolicFactor&) = delete;
};

/// A matrix as CHOLMOD sees it, without a copy.
/// @param lower  lower triangle only, compressed
cholmod_sparse view_of(const Eigen::SparseMatrix<double>& lower);

}  // namespace flankwright
