#pragma once

#include <Eigen/Core>

namespace flankwright {

/// Whether a symmetric stiffness holds against every motion: the least eigenvalue of k_ij / sqrt(k_ii k_jj), which has a diagonal of 1, is at least
/// 1e-7. Below that a stiffness written to seven digits may as well be singular, or have a motion that is driven instead of held; a factorisation
/// alone lets both pass by round-off.
/// @param stiffness  n x n; each row and column in any unit
bool is_positive_definite(const Eigen::MatrixXd& stiffness);

}  // namespace flankwright
