#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "core/compliance/finite_element/gear_mesh.hpp"
#include "core/compliance/tooth/station_grid.hpp"

namespace flankwright {

/// How the rim of a gear on a web moves under forces on its flanks: translation and rotation (t, omega) of the rigid motion
///
///     u = t + omega x x,   x from the axis at mid face,
///
/// that fits the displacements of the rim's material between root circle and underside best (least squares over the volume; exact for a rigid motion). Two such
/// fits: of the whole rim, and of the rim within half a pitch of a tooth, which tilts more than the whole where a thin rim twists under the load. Forces are those
/// of NetFunctionals, with the same motion removed as in the gear's influence values; axial_hold_compliance() is not in it. Frame: GearToMesh with tooth 0 along +y at mid face.
struct RimMotionTable {
  StationGrid grid;  ///< points of the forces
  /// (E m_n t, E m_n^2 omega) of the whole rim under unit forces at the points of the grid on tooth 0, 6 x grid.size() [-].
  Eigen::MatrixXd whole;
  /// The same of the rim below tooth 0, under forces on tooth m, for m = -M .. M.
  std::vector<Eigen::MatrixXd> below;

  int teeth_each_side() const { return static_cast<int>(below.size() / 2); }
};

/// The motion of the rim below tooth 0, six rows, and of the whole rim, six more, as functionals of the nodes' displacements, 3n x 12 [mm, rad].
/// @param mesh  of a gear on a web
Eigen::SparseMatrix<double> rim_functionals(const GearMesh& mesh);

/// @param motions  of rim_functionals() under unit forces at the points of the grid on teeth -M .. M, one tooth after the other; E = 1
RimMotionTable rim_motion_table(const GearMesh& mesh, const StationGrid& grid, const Eigen::MatrixXd& motions);

}  // namespace flankwright
