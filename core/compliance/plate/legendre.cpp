#include "core/compliance/plate/legendre.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace flankwright {

LegendreValues LegendreBasis::at(double x) const {
  const double length = high_ - low_;
  const double xi = (2 * x - low_ - high_) / length;
  // P_i and P_i' by the three-term recurrence, scaled at the end.
  LegendreValues p{Eigen::VectorXd::Ones(count_), Eigen::VectorXd::Zero(count_)};
  if (count_ > 1) {
    p.value[1] = xi;
    p.slope[1] = 1;
  }
  for (int i = 2; i < count_; ++i) {
    p.value[i] = ((2 * i - 1) * xi * p.value[i - 1] - (i - 1) * p.value[i - 2]) / i;
    p.slope[i] = p.slope[i - 2] + (2 * i - 1) * p.value[i - 1];
  }
  for (int i = 0; i < count_; ++i) {
    const double norm = std::sqrt((2 * i + 1) / length);
    p.value[i] *= norm;
    p.slope[i] *= norm * 2 / length;
  }
  return p;
}

Eigen::MatrixXd LegendreBasis::slope_products() const {
  // On [-1, 1] the integral of P_i' P_j is 2 for j = i - 1, i - 3 ..., else 0.
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(count_, count_);
  for (int i = 0; i < count_; ++i) {
    for (int j = i - 1; j >= 0; j -= 2) {
      C(i, j) = 2 * std::sqrt(static_cast<double>((2 * i + 1) * (2 * j + 1))) / (high_ - low_);
    }
  }
  return C;
}

GaussRule::GaussRule(int n) {
  // Golub and Welsch: nodes are the eigenvalues of the recurrence's matrix, weights the first components squared.
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd beside(n - 1);
  for (int k = 1; k < n; ++k) beside[k - 1] = k / std::sqrt(4.0 * k * k - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside);
  nodes = solver.eigenvalues();
  weights = 2 * solver.eigenvectors().row(0).cwiseAbs2().transpose();
}

}  // namespace flankwright
