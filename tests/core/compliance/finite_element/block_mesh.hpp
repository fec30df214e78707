#pragma once

#include <Eigen/LU>
#include <array>
#include <functional>
#include <map>
#include <vector>

#include "core/compliance/finite_element/solid_model.hpp"

namespace flankwright::test {

using Map3 = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// The unit cube in nx x ny x nz bricks, every node (mid-sides too) moved by `map`. `cube` receives where in the unit
/// cube each node was.
inline SolidMesh block_mesh(int nx, int ny, int nz, const Map3& map, Eigen::Matrix3Xd* cube = nullptr) {
  // Half steps (i, j, k) of a brick's nodes in the order of BrickNodes.
  constexpr int kSteps[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
                                 {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
  std::map<std::array<int, 3>, int> numbers;
  std::vector<Eigen::Vector3d> stations;
  SolidMesh mesh;
  mesh.bricks.resize(20, nx * ny * nz);
  int brick = 0;
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      for (int k = 0; k < nz; ++k, ++brick) {
        for (int n = 0; n < 20; ++n) {
          const std::array<int, 3> step{2 * i + kSteps[n][0], 2 * j + kSteps[n][1], 2 * k + kSteps[n][2]};
          const auto [found, added] = numbers.try_emplace(step, static_cast<int>(stations.size()));
          if (added) stations.push_back({step[0] / (2.0 * nx), step[1] / (2.0 * ny), step[2] / (2.0 * nz)});
          mesh.bricks(n, brick) = found->second;
        }
      }
    }
  }
  mesh.nodes.resize(3, static_cast<Eigen::Index>(stations.size()));
  if (cube) cube->resize(3, mesh.nodes.cols());
  for (Eigen::Index n = 0; n < mesh.nodes.cols(); ++n) {
    mesh.nodes.col(n) = map(stations[n]);
    if (cube) cube->col(n) = stations[n];
  }
  return mesh;
}

/// Supports that hold every node for which `held` says so, in all directions.
inline std::vector<NodeSupport> hold(const Eigen::Matrix3Xd& stations, const std::function<bool(const Eigen::Vector3d&)>& held) {
  std::vector<NodeSupport> supports;
  for (int n = 0; n < stations.cols(); ++n) {
    if (held(stations.col(n))) supports.push_back({n});
  }
  return supports;
}

/// Calls use(brick, shape, position, gradient of the shape functions 20 x 3, weight) at all integration points.
template <typename Use>
void integrate(const SolidMesh& mesh, Use&& use) {
  for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
    const BrickNodes nodes = mesh.brick_nodes(e);
    for (int i = 0; i < 27; ++i) {
      const int a = i % 3, b = i / 3 % 3, c = i / 9;
      const BrickShape shape = brick_shape({gauss3_abscissae[a], gauss3_abscissae[b], gauss3_abscissae[c]});
      const Eigen::Matrix3d jacobian = nodes * shape.derivatives;
      const Eigen::Vector3d position = nodes * shape.values;
      const Eigen::Matrix<double, 20, 3> gradient = shape.derivatives * jacobian.inverse();
      use(e, shape, position, gradient, gauss3_weights[a] * gauss3_weights[b] * gauss3_weights[c] * jacobian.determinant());
    }
  }
}

}  // namespace flankwright::test
