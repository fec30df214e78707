#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "core/compliance/finite_element/gear_mesh.hpp"
#include "core/compliance/tooth/station_grid.hpp"

namespace flankwright {

/// A point on the fillet below the loaded flank of tooth 0, in the frame of GearToMesh.
struct FilletPoint {
  double along{not_given};  ///< arc length from the fillet's start over length(): 0 .. 1 at its lowest point [-]
  double z{not_given};      ///< -b/2 .. b/2 [mm]
};

/// Stress at the free surface of the fillet as a linear functional of the nodes' displacements.
///
/// No traction acts there, so that stress has three components, in the tangent plane: along t, the fillet's tangent in
/// the transverse plane, downwards, and along a, across it towards +z. Plane-stress Hooke applies to the strain in
/// that plane, which the displacements of the surface alone decide,
///
///     s_tt = E/(1-nu^2) (e_tt + nu e_aa),   s_aa = E/(1-nu^2) (e_aa + nu e_tt),   s_ta = E/(2 (1+nu)) g_ta.
///
/// It is taken at the 2 x 2 Gauss points of the mesh's faces, where derivatives of quadratic elements are best (one
/// order more than elsewhere), and interpolated by cubic splines along the fillet and along z. The outermost of these
/// points lie 0.11 of an element from an edge; beyond them their stress is used.
class FilletStress {
 public:
  /// @throws InvalidInput  "material" out of range
  FilletStress(const GearMesh& mesh, const Material& material);

  /// Length of the fillet's arc in the transverse section, of the mesh's edges [mm]. Where no land is left between
  /// two fillets the last element reaches to the middle of the gap.
  double length() const { return ends_.back(); }
  /// Position of a point along the transverse fillet, 0 .. 1: nearest on the mesh's edges at z = -b/2.
  double along(const ProfilePoint& point) const;

  /// (s_tt, s_aa, s_ta) of point i in columns 3 i, 3 i + 1, 3 i + 2, of size 3 n: MPa per mm of displacement.
  Eigen::SparseMatrix<double> functionals(const std::vector<FilletPoint>& places) const;

 private:
  struct Layout;
  FilletStress(const GearMesh& mesh, const Material& material, const Layout& layout);

  double half_width_;
  Eigen::Matrix2Xd profile_;              ///< edge nodes in the tooth's own section: start, mid, end, mid ... [mm]
  std::vector<double> ends_;              ///< arc length at the ends of the elements along the fillet, from 0 [mm]
  SplineAxis along_, z_;                  ///< Gauss points
  Eigen::SparseMatrix<double> at_gauss_;  ///< functionals there, along the fillet fastest
};

/// Largest principal value of a symmetric 2 x 2 tensor and its unit direction (cos, sin).
struct PrincipalStress {
  double value{not_given};
  Eigen::Vector2d direction{not_given, not_given};
};
/// The largest principal stress of (s_tt, s_aa, s_ta); where both are equal its direction is t.
PrincipalStress largest_principal(const Eigen::Vector3d& stress);

/// d s_1 / d (s_tt, s_aa, s_ta) = (v_t^2, v_a^2, 2 v_t v_a): exact where s_1 is the larger one of two; where both are
/// the same, one of the subgradients.
Eigen::RowVector3d principal_slope(const PrincipalStress& principal);

}  // namespace flankwright
