#pragma once

#include <Eigen/Core>

#include "core/compliance/finite_element/brick.hpp"
#include "core/compliance/finite_element/section.hpp"

namespace flankwright {

/// Nodes of a quadratic edge in a transverse section [mm], 2 x 3: corner, mid-side, corner.
using EdgeNodes = Eigen::Matrix<double, 2, 3>;

inline EdgeNodes edge_nodes(const SectionMesh& mesh, const SectionEdge& edge) {
  EdgeNodes nodes;
  for (int i = 0; i < 3; ++i) nodes.col(i) = mesh.nodes.col(edge[static_cast<std::size_t>(i)]);
  return nodes;
}

/// The shape functions of the three nodes at a local position x, -1 at the first corner and 1 at the last, and their derivatives by x.
struct EdgeShape {
  Eigen::Vector3d values, derivatives;
  explicit EdgeShape(double x) : values(0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)), derivatives(x - 0.5, -2 * x, x + 0.5) {}
};

/// Arc length of an edge from its first corner to a local position [mm], by three Gauss points.
/// @param to  local position, -1 .. 1; -1 gives 0
inline double arc_length(const EdgeNodes& nodes, double to) {
  const double half = (to + 1) / 2;
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += gauss3_weights[i] * half * (nodes * EdgeShape(-1 + half * (1 + gauss3_abscissae[i])).derivatives).norm();
  return sum;
}

}  // namespace flankwright
