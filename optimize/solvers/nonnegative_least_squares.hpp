#pragma once

#include <Eigen/Core>

namespace flankwright {

/// minimise |A y - b|^2  subject to  y >= 0        [Lawson & Hanson, Solving Least Squares Problems (1974), ch. 23]
///
/// Their active-set method: columns enter by the steepest descent and leave where they would turn negative; the first of equals
/// enters, so the same input gives the same bits. Columns that depend on those already in are left at 0.
/// @param A  m x n, finite; m, n >= 0
/// @param b  m
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The same with |pull y|^2 added, element by element: that of A with a diagonal of these below, which is not formed.
/// @param pull  n, finite
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& pull);

}  // namespace flankwright
