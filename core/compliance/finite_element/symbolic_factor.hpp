#pragma once

#include <cholmod.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/compliance/finite_element/elimination_order.hpp"

namespace flankwright {

/// The pattern of the supernodal Cholesky factor P A P' = L L' of a sparse matrix of node blocks, by CHOLMOD, in the
/// order given. The factor has no numbers yet.
struct SymbolicFactor {
  cholmod_common common;
  cholmod_factor* l{nullptr};  ///< null where memory did not suffice

  /// @param order  of the same matrix, made; keep OneCore while this runs
  SymbolicFactor(const Eigen::SparseMatrix<double>& lower, const EliminationOrder& order);
  ~SymbolicFactor();
  SymbolicFactor(const SymbolicFactor&) = delete;
  SymbolicFactor& operator=(const SymbolicFactor&) = delete;
};

/// A matrix as CHOLMOD sees it, without a copy.
/// @param lower  lower triangle only, compressed
cholmod_sparse view_of(const Eigen::SparseMatrix<double>& lower);

}  // namespace flankwright
