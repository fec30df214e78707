#include "tests/reference/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace flankwright {

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace flankwright
