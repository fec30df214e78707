#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "core/compliance/finite_element/brick.hpp"
#include "core/compliance/finite_element/section_mesh.hpp"
#include "core/compliance/finite_element/sparse_cholesky.hpp"

namespace flankwright {

/// Stiffness of a curved 8-node quad in plane strain, 1 mm thick, 16 x 16 [N/mm], unknowns node by node (x, y), full 3 x 3 Gauss integration.
/// @param nodes     [mm], 2 x 8 as in SectionMesh
/// @param material  youngs_modulus > 0 and 0 <= poissons_ratio < 0.5
Eigen::Matrix<double, 16, 16> quad_stiffness(const Eigen::Matrix<double, 2, 8>& nodes, const Material& material);

/// A gear's transverse section in plane strain, factorised once for many loads.
class PlaneStrainSection {
 public:
  /// @param mesh  without ties (GearMeshOptions::layer_share 0)
  /// @param held  nodes that do not move
  PlaneStrainSection(const SectionMesh& mesh, const Material& material, const std::vector<int>& held);

  /// Not Factorised where the held nodes leave a rigid motion free; then solve() may not be called.
  FactorStatus status() const { return factor_.status(); }
  /// Displacements [mm] under loads per thickness [N/mm], 2n x k, node by node (x, y).
  Eigen::MatrixXd solve(const Eigen::MatrixXd& loads) const;

 private:
  struct Unknowns {
    Eigen::VectorXi of_node;  ///< first unknown of every node, -1 where it is held
    Eigen::VectorXi node_of;  ///< node of every unknown
  };
  PlaneStrainSection(Unknowns&& unknowns, const SectionMesh& mesh, const Material& material);

  Unknowns unknowns_;
  SparseCholesky factor_;
};

}  // namespace flankwright
