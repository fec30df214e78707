#pragma once

#include <Eigen/Geometry>

#include "core/compliance/finite_element/load_functional.hpp"

namespace flankwright::test {

/// Consistent nodal loads of a unit load that presses on the flank itself, along its inward normals, spread over
/// spread [mm] around a point as 1 - (distance/spread)^2. Size 3 n.
inline Eigen::VectorXd flank_traction(const GearMesh& mesh, const FlankPoint& point, double spread) {
  const LoadFrame frame = load_frame(mesh, point);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(mesh.solid.nodes.size());
  double total = 0;
  constexpr int kParts = 6;  // per side of a face: its own size is that of the spread
  for (const MeshFace& face : mesh.surfaces(point.tooth).flank) {
    const FaceNodes nodes = mesh.face_nodes(face);
    for (int i = 0; i < 9 * kParts * kParts; ++i) {
      const int row = i / (3 * kParts), column = i % (3 * kParts);
      const auto local = [](int k) { return -1 + (2 * (k / 3) + 1 + gauss3_abscissae[k % 3]) / kParts; };
      const FaceShape shape = face_shape(local(row), local(column));
      const double share = 1 - (nodes * shape.values - frame.position).squaredNorm() / (spread * spread);
      if (share <= 0) continue;
      const Eigen::Matrix<double, 3, 2> tangents = nodes * shape.derivatives;
      Eigen::Vector3d area = tangents.col(0).cross(tangents.col(1));
      if (area.dot(frame.normal) < 0) area = -area;
      const double pressure = share * gauss3_weights[row % 3] * gauss3_weights[column % 3];
      total += pressure * area.norm();
      for (int k = 0; k < 8; ++k) load.segment<3>(3 * face[k]) -= pressure * shape.values[k] * area;
    }
  }
  return load / total;
}

}  // namespace flankwright::test
