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
  double z{not_given};       ///< -b/2 .. b/2 [mm]; the acute end is -b/2
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

/// A load on a flank and a deflection of it are one functional of the finite-element model:
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
/// s lies source_height of p's depth above the foot of the load along the normal, the foot being where the line of
/// action through p meets the centre surface. At the acute end of a helical tooth the line leaves through the end face
/// before it gets there; then the foot is turned back along the helix to the end. With s = p the weights would be those
/// of the load itself; but then load and deflection are both means over the same area, while the contact law counts
/// down to the point below the load. Under a line load across a spur tooth's face (18 and 40 teeth) that is 2 to 3 %
/// too little at half height and 6 to 11 % at the tip, against the load on the flank and the deflection of the centre
/// right below it [Haddad 1991, 2.5]. Half the height about halves this; less would need a finer mesh.
///
/// Only the part of the centre surface that exists carries: it ends at the tip, at both face ends and at the bore. The
/// part of w_p that falls outside is made up for by a factor (c_0 + c_1 xi + c_2 eta) on the rest, xi and eta being the
/// levers across the line of action through p; the constants follow from
///
///     integral of w_p dA = 1,   integral of w_p xi dA = 0,   integral of w_p eta dA = 0,
///
/// so that force and moment about every axis are the load's, wherever s is. This matters: with the torque alone kept,
/// and s on the line even beyond the end face, a point's deflection under its own load falls over the last 0.3 modules
/// before the acute end. Haddad's, for a load on the flank and the centre surface right below it or at the end, grows
/// [2.5]. E m_n K at distances from the acute end in modules (18 teeth, 30 deg, b = 6 m_n):
///
///                                            tip: 0   0.2   0.5    half height: 0   0.2   0.5    root: 0   0.2   0.5
///     load on flank, centre below           13.5  12.3   7.7                  5.4   5.1   3.8        2.4   2.4   2.0
///     s on the line, torque only             7.5  10.8   8.0                  2.8   3.3   3.4        1.5   1.6   1.7
///     s turned back, torque only            10.4  10.8   8.0                  3.4   3.5   3.4        1.7   1.7   1.7
///     s turned back, all moments            13.1  11.7   8.1                  5.8   4.9   3.8        4.2   3.3   2.2
///
/// and between points at least 0.7 modules apart, against load and deflection both on the flank, 95 % (all) of the
/// values are within 30 (58), 26 (57) and 12 (20) % of sqrt(K(p,p) K(q,q)) in rows two to four; the first row made
/// symmetric is within 10 (33) %. At the root's acute corner the last row is above the first: a load beyond the end
/// bends the corner, which the centre surface's deflection at the end alone does not show.
///
/// The integral is taken over the mesh's faces with their own shape functions, subdivided near s.
///
/// @returns  size 3 n, the consistent nodal loads of a unit load [N/N]
Eigen::SparseVector<double> centre_functional(const GearMesh& mesh, const FlankPoint& point);

/// Radius of the patch of flank_functional() [m_n].
inline constexpr double flank_patch = 0.4;

/// The same load where it acts, on the flank: a pressure 1 - (R/rho)^2 within rho = flank_patch of the point, along the point's own inward normal, cut off at the tip,
/// at the form circle and at the face ends, where a linear factor keeps force and all moments as in centre_functional(). The difference of both
/// therefore is in equilibrium, and only what is near to the point feels it.
/// @returns  as centre_functional()
Eigen::SparseVector<double> flank_functional(const GearMesh& mesh, const FlankPoint& point);

/// Rigid motion of the shaft's section at a height z that fits its displacements best (least squares over its area):
/// u = t + omega x (x - (0, 0, z)). Exact for a rigid motion.
struct SectionMotion {
  std::vector<int> nodes;
  Eigen::Matrix<double, 6, Eigen::Dynamic> weights;  ///< (t, omega) = weights times the nodes' displacements, 6 x 3k
};

/// @param z  -b/2 .. b/2 [mm]
SectionMotion shaft_motion(const GearMesh& mesh, double z);

/// The rigid-body motion of the shaft that is removed from the compliance.
enum class RemovedRigidMotion {
  None,
  /// The transverse translation of the shaft's section in the plane of the point, and the shaft's rotation about its
  /// axis at the face end where the torque leaves, as app. 2C subtracts them. The gear's own torsion and its axial
  /// motion remain.
  TranslationAndTorsion,
  /// The tilt of the shaft's section at mid face as well. Then the shaft's supports have an axial force to carry and
  /// nothing else.
  TranslationTorsionAndTilt,
  /// The axial translation of the shaft's section in the plane of the point as well: for a shaft with its own model,
  /// held by its bearings. The supports then carry nothing; they only keep the end sections round and flat (1e-3 of K).
  WholeTranslationTorsionAndTilt,
};

/// The functionals of many points with the removed motion taken off,
///
///     l_p - F_x t_x(z_p) - F_y t_y(z_p) - M_z omega_z(torque end) [- M_x omega_x(0) - M_y omega_y(0)] [- F_z t_z(z_p)],
///
/// F and M being force and moment of l_p about the axis in the plane z_p. They serve for load and deflection: the load
/// that belongs to one has its reactions on the shaft right where the motion is measured. Hence P' K P instead of K P,
/// symmetric and positive semi-definite again. Kept in parts: the shaft's motions are the same for all points of a plane.
struct NetFunctionals {
  Eigen::SparseMatrix<double> centre;     ///< l_p of every point, 3n x k
  Eigen::SparseMatrix<double> motions;    ///< components of t and omega that are needed, 3n x m
  Eigen::SparseMatrix<double> taken_off;  ///< forces and moments, m x k
  /// centre - motions taken_off, 3n x k.
  Eigen::SparseMatrix<double> whole() const;
};
NetFunctionals net_functionals(const GearMesh& mesh, const std::vector<FlankPoint>& points, RemovedRigidMotion removed);

/// Diameter of what holds the shaft axially, over the shaft's.
inline constexpr double axial_hold_share = 0.2;

/// Deflection of the shaft's axial support along the normals [mm/N]. It is the same at all points of all teeth and is
/// added to every K(p, q),
///
///     sin^2(beta_b) 16 (1 - nu^2) / (3 pi^2 E a),    a = axial_hold_share d_s / 2,
///
/// the mean displacement of a disc under an even pressure on a half space [Timoshenko and Goodier, Theory of
/// Elasticity, art. 139]; 0 where the axial motion is removed, the bore held or the body rigid. It changes only the mean
/// transmission error.
///
/// Haddad holds the central node of one end [1991, 2.5], so that his deflections contain the local deflection at that
/// node. At a node, or at the edge of a narrow bore, this grows without limit as elements shrink; the value here does
/// not depend on the mesh. The thesis leaves the fraction open. A fifth fits the least influence values of an
/// independent finite-element calculation (0.21, 0.22, 0.27 with 27, 40, 60 teeth, 0.26 with 18; an error of 2 % in
/// those values would be 0.01, 0.01, 0.05 and 0.01 of it). Haddad's table 2B.1 alone would give 0.15 to 0.16, which
/// makes f_t of his 18:54 pair 0.2 um of 8 more.
double axial_hold_compliance(const GearMesh& mesh, const Material& material, RemovedRigidMotion removed);

}  // namespace flankwright
