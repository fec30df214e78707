#pragma once

#include <Eigen/Geometry>

#include "core/compliance/finite_element/load_functional.hpp"

namespace flankwright::test {

/// Consistent nodal loads of a pressure on the flank itself, of a resultant pressure of one. Size 3 n.
/// @param parts     per side of a face
/// @param pressure  of a position on the flank [any unit], nothing where it is not above 0
/// @param along     the load's direction against the flank times the size of a vector area of either sign: area itself, turned outwards, is a traction
template <typename Pressure, typename Along>
Eigen::VectorXd flank_load(const GearMesh& mesh, int tooth, int parts, Pressure&& pressure, Along&& along) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(mesh.solid.nodes.size());
  double total = 0;
  const auto local = [&](int k) { return -1 + (2 * (k / 3) + 1 + gauss3_abscissae[k % 3]) / parts; };
  for (const MeshFace& face : mesh.surfaces(tooth).flank) {
    const FaceNodes nodes = mesh.face_nodes(face);
    for (int i = 0; i < 9 * parts * parts; ++i) {
      const int row = i / (3 * parts), column = i % (3 * parts);
      const FaceShape shape = face_shape(local(row), local(column));
      const double share = pressure(nodes * shape.values) * gauss3_weights[row % 3] * gauss3_weights[column % 3];
      if (!(share > 0)) continue;
      const Eigen::Matrix<double, 3, 2> tangents = nodes * shape.derivatives;
      const Eigen::Vector3d area = tangents.col(0).cross(tangents.col(1));
      total += share * area.norm();
      for (int k = 0; k < 8; ++k) load.segment<3>(3 * face[k]) -= share * shape.values[k] * along(area);
    }
  }
  return load / total;
}

/// A unit load that presses on the flank itself, along its inward normals, spread over spread [mm] around a point as 1 - (distance/spread)^2.
inline Eigen::VectorXd flank_traction(const GearMesh& mesh, const FlankPoint& point, double spread) {
  const LoadFrame frame = load_frame(mesh, point);
  const auto pressure = [&](const Eigen::Vector3d& x) { return 1 - (x - frame.position).squaredNorm() / (spread * spread); };
  const auto outwards = [&](const Eigen::Vector3d& area) -> Eigen::Vector3d { return area.dot(frame.normal) < 0 ? -area : area; };
  return flank_load(mesh, point.tooth, 6, pressure, outwards);  // a face's own size is that of the spread
}

}  // namespace flankwright::test
