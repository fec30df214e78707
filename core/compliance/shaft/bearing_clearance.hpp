#pragma once

#include <Eigen/Core>
#include <vector>

namespace flankwright {

/// Where shafts lie within the clearances of their bearings.
struct ClearanceState {
  Eigen::VectorXd shift;  ///< x and y of each shaft's section in its bearing, 2 m [mm]; within the clearance where the bearing does not carry
  Eigen::VectorXd force;  ///< of each shaft on its bearing, 2 m [N]; 0 where it does not carry
  std::vector<bool> carries;
  double residual{-1.0};  ///< |shift - P(shift + gamma force)| over the largest clearance; converged at most clearance_residual [-]
  int iterations{-1};
  bool converged{false};
};

/// Where iterations end: largest |shift - P(shift + gamma force)| over the largest clearance, see solve_clearances() [-].
inline constexpr double clearance_residual = 1e-11;

/// Equilibrium of shafts on bearings with radial clearance. With all clearances closed the bearings would carry the forces F0; shifts v of the shafts
/// in them change these to F = F0 - N v. A shaft lies at the border of the clearance, pressed against it, or carries nothing:
///
///     F_i in the normal cone of |v_i| <= c_i at v_i,   that is   v = P(v + gamma F(v)),
///
/// with P the nearest point within every clearance: the minimum of 1/2 v'N v - F0'v, a convex programme. Newton's method on the equation, with projected
/// gradients where a step does not shorten the residual.
///
/// @param forces     F0, x and y of each of m bearings [N]
/// @param stiffness  N, 2m x 2m, symmetric, positive semi-definite [N/mm]
/// @param clearance  c, half the radial clearance, m [mm], > 0
ClearanceState solve_clearances(const Eigen::VectorXd& forces, const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& clearance);

}  // namespace flankwright
