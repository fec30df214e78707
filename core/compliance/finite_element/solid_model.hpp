#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/compliance/finite_element/brick.hpp"
#include "core/compliance/finite_element/multifrontal_gram.hpp"
#include "core/compliance/finite_element/sparse_cholesky.hpp"

namespace flankwright {

/// A node that follows others: u = sum of weight u(other). None of the others is tied.
struct TiedNode {
  int node{-1};
  std::vector<std::pair<int, double>> follows;  ///< node and weight
};

/// A body of n nodes and m curved 20-node bricks.
struct SolidMesh {
  Eigen::Matrix3Xd nodes;                         ///< [mm], 3 x n
  Eigen::Matrix<int, 20, Eigen::Dynamic> bricks;  ///< node numbers, 20 x m, in the order of BrickNodes
  std::vector<TiedNode> tied{};
  /// Young's modulus of every brick over that of the material, > 0; empty: 1.
  std::vector<double> stiffness{};

  BrickNodes brick_nodes(Eigen::Index brick) const;
  /// Smallest brick_quality() of the mesh.
  double quality() const;
};

/// A node whose displacement is held at 0 along some directions.
struct NodeSupport {
  int node{-1};
  std::array<bool, 3> fixed{true, true, true};         ///< along the columns of `frame`
  Eigen::Matrix3d frame{Eigen::Matrix3d::Identity()};  ///< orthonormal
};

/// Stiffness of a linear elastic body,
///
///     A = assembled brick_stiffness(),   u = 0 along the supports, tied nodes as what they follow.
struct SolidStiffness {
  Eigen::SparseMatrix<double> lower;   ///< of A, n x n, lower triangle only, compressed
  Eigen::SparseMatrix<double> motion;  ///< displacements of the nodes by the unknowns, which are along the supports' frames, 3 nodes x n
  Eigen::VectorXi node_of;             ///< of every unknown, ascending, size n

  /// @throws InvalidInput  as SolidModel
  SolidStiffness(const SolidMesh& mesh, const Material& material, const std::vector<NodeSupport>& supports);
};

/// Linear elastic body, factorised once for many loads:
///
///     A u = f,   A: SolidStiffness.
///
/// Displacements and loads are vectors of size 3 n, node by node (x, y, z) [mm], [N].
class SolidModel {
 public:
  /// @throws InvalidInput  "material" out of range; "mesh" with a node number out of range, a node in no brick, or a
  ///                       brick whose Jacobian is not positive; "mesh.tied" where a node follows one out of range or
  ///                       tied itself; "supports" with a node out of range or tied
  SolidModel(const SolidMesh& mesh, const Material& material, const std::vector<NodeSupport>& supports);

  /// Not Factorised where the supports leave a rigid motion free; then nothing below may be called.
  FactorStatus status() const { return factor_.status(); }
  Eigen::Index unknowns() const { return motion_.cols(); }
  const SparseCholesky& factor() const { return factor_; }

  /// A^-1 F, 3n x k.
  Eigen::MatrixXd solve(const Eigen::SparseMatrix<double>& loads) const;
  /// F' A^-1 F, k x k: exactly symmetric, and positive semi-definite to round-off. Its cost grows with the loaded part
  /// of the body, and is a small fraction of that of solve().
  Eigen::MatrixXd influence(const Eigen::SparseMatrix<double>& loads) const;

 private:
  explicit SolidModel(SolidStiffness&& stiffness);

  Eigen::SparseMatrix<double> motion_;  ///< as SolidStiffness::motion
  SparseCholesky factor_;
};

/// SolidModel::influence() of one set of loads without a factor that is kept, for a fraction of its memory.
/// @param stiffness, loads  taken(), and freed as soon as they were read
/// @param memory_limit, for_each, order  as multifrontal_gram()
MultifrontalGram influence_at_once(SolidStiffness&& stiffness, Eigen::SparseMatrix<double>&& loads, double memory_limit,
                                   const EliminationProgress& progress = {}, const ForEachIndex& for_each = {}, EliminationOrder order = {});

}  // namespace flankwright
