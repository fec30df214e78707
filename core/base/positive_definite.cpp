#include "core/base/positive_definite.hpp"

#include <Eigen/Eigenvalues>

namespace flankwright {

bool is_positive_definite(const Eigen::MatrixXd& stiffness) {
  constexpr double least = 1e-7;
  if (!(stiffness.diagonal().array() > 0.0).all()) return false;
  const Eigen::VectorXd scale = stiffness.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * stiffness * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues().minCoeff() >= least;
}

}  // namespace flankwright
