#pragma once

#include <cholmod.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace flankwright {

/// B' A^-1 B of a sparse B, n x k, by a supernodal factor P A P' = L L' of A: the Gram matrix of Y = L^-1 P B, k x k, exactly
/// symmetric, and positive semi-definite to round-off.
///
/// Y is never there as a whole. A column of B reaches the supernodes of its entries and those between them and the root
/// of the elimination tree, a small part of L where its entries are close together. Supernodes are processed upwards
/// once, each with all columns that reach it:
///
///     Y_s = L_ss^-1 W_s,    G += Y_s' Y_s,    W_t -= L_ts Y_s  for the supernodes t above.
///
/// Only what waits above the supernode at work, W_t, is held: at most k times the rows of the largest separators.
/// @throws std::bad_alloc
Eigen::MatrixXd supernodal_gram(const cholmod_factor& factor, const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides);

}  // namespace flankwright
