#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "core/compliance/finite_element/gear_mesh.hpp"

namespace flankwright {

/// A point of the loaded flank of one of the detailed teeth, in the frame of GearToMesh.
struct FlankPoint {
  int tooth{0};              ///< -teeth_each_side .. teeth_each_side
  double radius{not_given};  ///< form radius .. tip radius [mm]
  double z{not_given};       ///< -b/2 .. b/2 [mm]; the sharp end is -b/2
};

/// Position and directions at a flank point.
struct LoadFrame {
  Eigen::Vector3d position;  ///< [mm]
  Eigen::Vector3d normal;    ///< outward, unit
  double depth;              ///< along the inward normal to the tooth's centre surface, continued past the ends [mm]
};

/// The depth is the exact one, where (s_yt/2) cos(beta_b) / cos(alpha_yt) [Haddad 1991, eq. 2.2] takes the arc for the
/// chord and no account of the tooth's taper: 1 to 10 % more.
///
/// @throws InvalidInput  "point" outside the ranges of FlankPoint
LoadFrame load_frame(const GearMesh& mesh, const FlankPoint& point);

/// Height of the weights' source above the centre surface, of the depth of the centre surface below the flank.
inline constexpr double source_height = 0.5;

/// What a load on a flank, and a deflection of it, mean to the finite-element model: one functional for both,
///
///     l_p(u) = integral over the tooth's centre surface of w_p(x) (-n_p) . u(x) dA,
///     w_p ~ (3 / 2 pi) a^2 |d . nu| / R^5,   d = x - s,  R = |d|,  a = -n_p . d > 0  (0 where a <= 0),
///
/// the part of a half-space's stress under a point load at s that acts along the load (Boussinesq; radial towards s, so
/// that its flux through every surface with unit normal nu that cuts the half-space is the load; the transverse
/// pressure that depends on Poisson's ratio is left out). On a plane across the normal, h away from s, this is
/// 3 h^3 / (2 pi R^5). Load and deflection are along the inward normal, so that K = l_p(A^-1 l_q) is symmetric and
/// positive semi-definite whatever mesh and weights are.
///
/// s lies on the line of action through p, source_height of p's depth above the centre surface. With s = p the weights
/// would be those of the load itself; but then load and deflection are both means over the same area, while the contact
/// law counts down to the point below the load. Under a line load across a spur tooth's face (18 and 40 teeth) that is
/// 2 to 3 % too little at half height and 6 to 11 % at the tip, against the load on the flank and the deflection of the
/// centre right below it [Haddad 1991, 2.5]. Half the height about halves this; less would need a finer mesh.
///
/// Only the part of the centre surface that exists carries: it ends at the tip, at both face ends and at the bore. What
/// of w_p falls outside is made up for by a factor (c_0 + c_1 xi) on the rest, xi being the lever about the gear's axis
/// relative to that of the line of action; both constants follow from
///
///     integral of w_p dA = 1,   integral of w_p xi dA = 0,
///
/// so that force and torque are the load's. At the sharp end, where the normal leaves through the end face before it
/// meets the centre surface, the load thus enters where the centre surface is nearest; only its tilting moment changes.
/// A limit of this: over the last 0.3 modules before that end a point's own deflection under its own load falls, to
/// about half of what a load on the flank gives there (18 and 40 teeth, 30 deg).
///
/// The integral is taken over the mesh's faces with their own shape functions, subdivided near s.
///
/// @returns  size 3 n, the consistent nodal loads of a unit load [N/N]
Eigen::SparseVector<double> centre_functional(const GearMesh& mesh, const FlankPoint& point);

/// Rigid motion of the shaft's section at a height z that fits its displacements best (least squares over its area):
/// u = t + omega x (x - (0, 0, z)). Exact for a rigid motion.
struct SectionMotion {
  std::vector<int> nodes;
  Eigen::Matrix<double, 6, Eigen::Dynamic> weights;  ///< (t, omega) = weights times the nodes' displacements, 6 x 3k
};

/// @param z  -b/2 .. b/2 [mm]
SectionMotion shaft_motion(const GearMesh& mesh, double z);

/// What of the shaft's motion is taken out of the compliance.
enum class RemovedMotion {
  None,
  /// The translation of the shaft's section in the plane of the point, and the shaft's rotation about its axis at the
  /// face end z = -b/2, where the torque leaves. The gear's own wind-up stays in.
  TranslationAndTorsion,
  /// And the tilt of the shaft's section at mid face. Then the shaft's supports have no force or moment to carry, and
  /// how the shaft is held matters only as far as its end sections are kept round and flat (1e-3 of K).
  TranslationTorsionAndTilt,
};

/// The functional with the removed motion taken off,
///
///     l_p - F . t(z_p) - M_z omega_z(-b/2) [- M_x omega_x(0) - M_y omega_y(0)],
///
/// F and M being force and moment of l_p about the axis in the plane z_p. It serves for load and deflection: the load
/// that belongs to it has its reactions on the shaft right where the motion is measured. Hence P' K P instead of K P,
/// symmetric and positive semi-definite again.
Eigen::SparseVector<double> net_functional(const GearMesh& mesh, const FlankPoint& point, RemovedMotion removed);

}  // namespace flankwright
