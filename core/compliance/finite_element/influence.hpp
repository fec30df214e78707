#pragma once

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
  double peak_bytes{not_given};     ///< held by the factorisation at most
  double model_seconds{not_given};  ///< wall time of mesh, assembly and factorisation
  double solve_seconds{not_given};  ///< wall time of all loads
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

/// Influence of forces on flanks on these, and on any other linear functional of the displacements.
struct FlankInfluence {
  /// As InfluenceMatrix::compliance: K(p, q) [mm/N], n x n.
  Eigen::MatrixXd compliance;
  /// Every reading under a unit force at every point, r x n.
  Eigen::MatrixXd readings;
};

/// @param solid     of the mesh, Factorised
/// @param readings  3n x r, functionals of the nodes' displacements; may have no columns
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
