#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/compliance/fitted/influence_sample.hpp"
#include "core/compliance/fitted/kernel_form.hpp"

namespace flankwright {

/// Values and derivatives of a KernelForm between fixed points. Terms of the points alone are computed once, terms of a
/// point and the coefficients once per set of coefficients; a pair costs one root pair, one division and one
/// exponential per kernel.
class KernelSum {
 public:
  /// @param form    validated
  /// @param gear    validated
  KernelSum(const KernelForm& form, const GearProportions& gear, std::span<const FlankStation> points);

  /// @param coefficients  size form.count()
  void set_coefficients(std::span<const double> coefficients);

  /// The kernels' part between all points, n x n, symmetric.
  Eigen::MatrixXd tooth_matrix() const;
  /// The gear body's part between all points, n x n, symmetric.
  Eigen::MatrixXd body_matrix() const;

  /// K(p, q) and its derivatives with respect to all coefficients.
  /// @param gradient  overwritten; size form.count()
  double with_gradient(Eigen::Index p, Eigen::Index q, std::span<double> gradient) const;

 private:
  struct KernelAtPoints {
    Eigen::MatrixXd amplitude_basis, axial_basis, radial_basis;  ///< count x n, one column per point
    Eigen::VectorXd h, axial_square, radial_square;              ///< h, lz^2, lr^2
    double inverse_lambda_square{0.0}, kappa{0.0};
    int offset{0};  ///< first coefficient
  };
  struct BodyAtPoints {
    Eigen::MatrixXd features;  ///< L beta, functions x n
    double inverse_tau{0.0};
    int offset{0};
  };

  void add_kernel(std::size_t k, Eigen::MatrixXd& lower) const;
  double kernel_gradient(std::size_t k, Eigen::Index p, Eigen::Index q, std::span<double> gradient) const;
  double body_gradient(std::size_t k, Eigen::Index p, Eigen::Index q, std::span<double> gradient) const;
  double turning_cosine(int teeth_apart) const;
  double torsion(Eigen::Index p, Eigen::Index q) const;
  double coupling(std::size_t body, int teeth_apart) const;

  KernelForm form_;
  int teeth_;
  int teeth_spanned_{0};                                                             ///< the largest |m_p - m_q|
  std::vector<int> tooth_;                                                           ///< n
  Eigen::VectorXd u_, zeta_;                                                         ///< n
  Eigen::Matrix<double, KernelForm::kWarpCoefficients, Eigen::Dynamic> warp_basis_;  ///< of w_0 and the tanh(w_i)
  Eigen::Matrix<double, KernelForm::kWarpCoefficients, 1> warp_slope_;               ///< d(w_0 or tanh w_i)/d w_i
  Eigen::VectorXd s_;                                                                ///< warped zeta, n
  Eigen::MatrixXd body_basis_;                                                       ///< beta, 10 x n
  double torsion_compliance_{0.0}, torsion_width_{0.0};                              ///< c, w
  Eigen::VectorXd torsion_reach_;                                                    ///< v(zeta), n; empty where the form has none
  int torsion_offset_{0};
  std::vector<KernelAtPoints> kernels_;
  std::vector<BodyAtPoints> bodies_;
};

}  // namespace flankwright
