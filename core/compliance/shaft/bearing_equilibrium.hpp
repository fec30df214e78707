#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/compliance/shaft/bearing_clearance.hpp"
#include "core/compliance/shaft/bearing_law.hpp"

namespace flankwright {

/// A bearing whose force is not in proportion to the displacement of the shaft in it.
struct NonlinearBearing {
  double clearance{0.0};         ///< c, half the radial clearance [mm], >= 0; > 0 where there is no law
  std::optional<RadialLaw> law;  ///< of the force beyond the clearance; nothing: at the border the shaft stops
};

/// Where iterations end: largest difference between the force of a law and that of the shaft, over the largest of the forces F0, see solve_bearings() [-]. A further
/// step by forces then leaves round-off, see ShaftPair::at_torque().
inline constexpr double bearing_residual = 1e-9;

/// Equilibrium of shafts on bearings with clearances and laws. With no displacement in any of these bearings they would carry the forces F0;
/// displacements v change these to F = F0 - N v. A bearing with a law f carries
///
///     f(|v| - c) v/|v|   where |v| > c, and nothing elsewhere,
///
/// one without it is as in solve_clearances(). Laws increase, so that v is the minimum of a convex energy,
///
///     1/2 v'N v - F0'v + sum of the integrals of f,    |v_i| <= c_i where there is no law,
///
/// which Newton's method finds: each step is a minimum of the quadratic model, over the clearances where there are bearings without a law, its length
/// that of the least energy along it. Without any law this is solve_clearances().
///
/// @param forces     F0, x and y of each of m bearings [N]
/// @param stiffness  N, 2m x 2m, symmetric, positive semi-definite [N/mm]
/// @return v as `shift`; `residual` is the larger of bearing_residual's and clearance_residual's measures
ClearanceState solve_bearings(const Eigen::VectorXd& forces, const Eigen::MatrixXd& stiffness, const std::vector<NonlinearBearing>& bearings);

/// A bearing as it is for small changes around an equilibrium.
struct BearingTangent {
  bool carries{false};                                  ///< false: it is not there
  Eigen::Matrix2d compliance{Eigen::Matrix2d::Zero()};  ///< of its displacement by its force [mm/N]
  Eigen::Vector2d prestrain{Eigen::Vector2d::Zero()};   ///< the displacement less compliance times force [mm]
};

/// Where the force F in the direction e displaces the shaft by c + delta(F),
///
///     delta'(F) e e' + (c + delta(F))/F (1 - e e').
///
/// @param force  of the shaft on the bearing [N], 0 where it does not carry
/// @param shift  of the shaft in the bearing [mm]
BearingTangent tangent_of(const NonlinearBearing& bearing, const Eigen::Vector2d& force, const Eigen::Vector2d& shift, bool carries);

}  // namespace flankwright
