#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace flankwright {

/// Minimiser of a strictly convex quadratic over loads with a force balance.
struct QuadraticMinimum {
  Eigen::VectorXd x;       ///< >= 0
  double multiplier{0.0};  ///< f of the balance
  Eigen::LLT<Eigen::MatrixXd> factor;  ///< of H over the points that were loaded last
  int factorisations{0};
  bool solved{false};
};

/// minimise 1/2 x'Hx + b'x  subject to  a'x = F,  x >= 0,   H symmetric positive definite, a > 0, F > 0.
///
/// Block principal pivoting (Portugal, Judice, Vicente 1994): all bounds that are violated on either side change at
/// once as long as their number falls, a few factorisations in all. Where it stalls, which takes a nearly singular H, a
/// primal active-set method goes on from its loads: every step lowers the objective, so that it ends. Signs count up to
/// the round-off of the terms they are sums of.
/// @param guess  points expected to be loaded, size n; all false is taken as all true
QuadraticMinimum minimise_quadratic(const Eigen::MatrixXd& H, const Eigen::VectorXd& b, const Eigen::VectorXd& a,
                                    double F, const Eigen::Array<bool, Eigen::Dynamic, 1>& guess);

}  // namespace flankwright
