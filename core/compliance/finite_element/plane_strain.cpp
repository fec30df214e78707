#include "core/compliance/finite_element/plane_strain.hpp"

#include <Eigen/LU>
#include <cassert>

namespace flankwright {
namespace {

Eigen::SparseMatrix<double> assembled(const SectionMesh& mesh, const Material& material, const Eigen::VectorXi& of_node, Eigen::Index unknowns) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(mesh.quads.cols()) * 136);
  for (Eigen::Index quad = 0; quad < mesh.quads.cols(); ++quad) {
    Eigen::Matrix<double, 2, 8> nodes;
    for (int i = 0; i < 8; ++i) nodes.col(i) = mesh.nodes.col(mesh.quads(i, quad));
    const Eigen::Matrix<double, 16, 16> stiffness = quad_stiffness(nodes, material);
    for (int i = 0; i < 16; ++i) {
      const int row = of_node[mesh.quads(i / 2, quad)];
      for (int j = 0; j < 16; ++j) {
        const int column = of_node[mesh.quads(j / 2, quad)];
        if (row < 0 || column < 0 || row + i % 2 < column + j % 2) continue;
        entries.emplace_back(row + i % 2, column + j % 2, stiffness(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> lower(unknowns, unknowns);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace

Eigen::Matrix<double, 16, 16> quad_stiffness(const Eigen::Matrix<double, 2, 8>& nodes, const Material& material) {
  const auto [E, nu] = material;
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  Eigen::Matrix<double, 16, 16> stiffness = Eigen::Matrix<double, 16, 16>::Zero();
  for (int point = 0; point < 9; ++point) {
    const FaceShape shape = face_shape(gauss3_abscissae[point % 3], gauss3_abscissae[point / 3]);
    const Eigen::Matrix2d jacobian = nodes * shape.derivatives;
    const double weight = gauss3_weights[point % 3] * gauss3_weights[point / 3] * jacobian.determinant();
    const Eigen::Matrix<double, 2, 8> gradient = (shape.derivatives * jacobian.inverse()).transpose();
    // K_ia,jb = integral of lambda g_ia g_jb + mu g_ib g_ja + mu delta_ab g_i . g_j, as brick_stiffness()
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) {
        const Eigen::Vector2d g = gradient.col(i), h = gradient.col(j);
        Eigen::Matrix2d block = lambda * g * h.transpose() + mu * h * g.transpose();
        block.diagonal().array() += mu * g.dot(h);
        stiffness.block<2, 2>(2 * i, 2 * j) += weight * block;
      }
    }
  }
  return stiffness;
}

PlaneStrainSection::PlaneStrainSection(const SectionMesh& mesh, const Material& material, const std::vector<int>& held)
    : PlaneStrainSection(
          [&] {
            assert(mesh.ties.empty());
            const auto n = static_cast<int>(mesh.nodes.cols());
            Unknowns unknowns{Eigen::VectorXi::Zero(n), Eigen::VectorXi(2 * n)};
            for (const int node : held) unknowns.of_node[node] = -1;
            int next = 0;
            for (int node = 0; node < n; ++node) {
              if (unknowns.of_node[node] < 0) continue;
              unknowns.of_node[node] = next;
              unknowns.node_of[next++] = node;
              unknowns.node_of[next++] = node;
            }
            unknowns.node_of.conservativeResize(next);
            return unknowns;
          }(),
          mesh, material) {}

PlaneStrainSection::PlaneStrainSection(Unknowns&& unknowns, const SectionMesh& mesh, const Material& material)
    : unknowns_(std::move(unknowns)), factor_(assembled(mesh, material, unknowns_.of_node, unknowns_.node_of.size()), unknowns_.node_of) {}

Eigen::MatrixXd PlaneStrainSection::solve(const Eigen::MatrixXd& loads) const {
  const Eigen::Index n = unknowns_.of_node.size();
  Eigen::MatrixXd right(unknowns_.node_of.size(), loads.cols());
  for (Eigen::Index node = 0; node < n; ++node) {
    if (const int row = unknowns_.of_node[node]; row >= 0) right.middleRows<2>(row) = loads.middleRows<2>(2 * node);
  }
  const Eigen::MatrixXd moved = factor_.solve(right);
  Eigen::MatrixXd displacements = Eigen::MatrixXd::Zero(2 * n, loads.cols());
  for (Eigen::Index node = 0; node < n; ++node) {
    if (const int row = unknowns_.of_node[node]; row >= 0) displacements.middleRows<2>(2 * node) = moved.middleRows<2>(row);
  }
  return displacements;
}

}  // namespace flankwright
