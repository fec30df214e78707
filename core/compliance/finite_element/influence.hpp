#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "core/compliance/finite_element/gear_mesh.hpp"
#include "core/compliance/finite_element/load_functional.hpp"

namespace flankwright {

/// The cost of a finite-element run.
struct RunStatistics {
  Eigen::Index bricks{-1};
  Eigen::Index unknowns{-1};
  double factor_entries{not_given};
  double peak_bytes{not_given};     ///< held by the factorisation at most; of an InfluenceTableRun by matrix, loads and elimination
  double model_seconds{not_given};  ///< wall time of mesh, assembly and factorisation; of an InfluenceTableRun up to the ordering
  double solve_seconds{not_given};  ///< wall time of all loads; of an InfluenceTableRun of elimination and loads, which are one
};

/// Influence values between flank points of one gear.
struct InfluenceMatrix {
  FactorStatus status{FactorStatus::NotPositiveDefinite};
  std::vector<FlankPoint> points;
  /// K(p, q): deflection at p along its inward normal per unit load at q along its own [mm/N], both as NetFunctionals
  /// defines them, with axial_hold_compliance(); local contact deflection and the removed motion are not in it. Exactly
  /// symmetric, positive semi-definite to round-off. Empty unless status is Factorised.
  Eigen::MatrixXd compliance;
  RunStatistics statistics;
};

/// Linear functionals of the displacements, one in each column.
using Functionals = Eigen::SparseMatrix<double>;
/// All columns of some, in this order.
/// @param rows  of each that has columns
Functionals side_by_side(std::initializer_list<const Functionals*> parts, Eigen::Index rows);

/// Influence of forces on flanks on these, and on any other linear functional of the displacements.
struct FlankInfluence {
  /// As InfluenceMatrix::compliance: K(p, q) [mm/N], n x n.
  Eigen::MatrixXd compliance;
  /// Every reading under a unit force at every point, r x n.
  Eigen::MatrixXd readings;
  /// Every reading under every other one taken as a load, r x r, for those that are in equilibrium.
  Eigen::MatrixXd between_readings;
};

/// The linear functionals from which a FlankInfluence is made: l_p of n points, m motions of the shaft and r readings.
struct FlankFunctionals {
  Eigen::SparseMatrix<double> all;        ///< n + m + r columns
  Eigen::SparseMatrix<double> taken_off;  ///< as NetFunctionals, m x n
  Eigen::Index points{0}, motions{0}, readings{0};

  /// @param readings  functionals of the nodes' displacements; may have no columns
  /// @throws InvalidInput  a point outside the ranges of FlankPoint
  FlankFunctionals(const GearMesh& mesh, const std::vector<FlankPoint>& flank, RemovedRigidMotion removed,
                   const Eigen::SparseMatrix<double>& readings);
  /// @param gram  all' A^-1 all
  /// @param hold  axial_hold_compliance() [mm/N]
  FlankInfluence influence(const Eigen::MatrixXd& gram, double hold) const;
};

/// @param solid     of the mesh, Factorised
/// @param readings  as FlankFunctionals
/// @throws InvalidInput  a point outside the ranges of FlankPoint
FlankInfluence solve_flank_influence(const GearMesh& mesh, const SolidModel& solid, const Material& material, const std::vector<FlankPoint>& points,
                                     RemovedRigidMotion removed, const Eigen::SparseMatrix<double>& readings = {});

/// Meshed and factorised gear, for any number of influence matrices.
class InfluenceModel {
 public:
  /// @throws InvalidInput  as gear_mesh() and SolidModel
  InfluenceModel(const GearToMesh& gear, const Material& material, const GearMeshOptions& options = {});

  const GearMesh& mesh() const { return mesh_; }
  const SolidModel& solid() const { return solid_; }
  const Material& material() const { return material_; }

  /// @throws InvalidInput  a point outside the ranges of FlankPoint
  InfluenceMatrix influence(const std::vector<FlankPoint>& points, RemovedRigidMotion removed = RemovedRigidMotion::TranslationTorsionAndTilt) const;

 private:
  Material material_;
  double started_;  ///< clock before the mesh was made [s]
  GearMesh mesh_;
  SolidModel solid_;
  double model_seconds_;
};

}  // namespace flankwright
