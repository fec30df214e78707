#pragma once

#include <Eigen/Core>

namespace flankwright {

/// Eigenvalues of a symmetric matrix (n x n, of which the lower triangle is read), ascending. Compiled once: as a template it would be a
/// third of the compile time of every test that asks whether a matrix is positive.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace flankwright
