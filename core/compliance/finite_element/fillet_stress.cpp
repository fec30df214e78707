#include "core/compliance/finite_element/fillet_stress.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/compliance/finite_element/quadratic_edge.hpp"

namespace flankwright {
namespace {

/// The three functionals at a local point of a face, on its nodes' displacements, 24 x 3.
Eigen::Matrix<double, 24, 3> face_stress(const FaceNodes& nodes, double xi, double eta, const Material& material) {
  const FaceShape shape = face_shape(xi, eta);
  const Eigen::Matrix<double, 3, 2> tangents = nodes * shape.derivatives;
  const Eigen::Vector3d t = tangents.col(0).normalized();
  const Eigen::Vector3d a = tangents.col(0).cross(tangents.col(1)).cross(t).normalized();
  Eigen::Matrix<double, 3, 2> frame;
  frame << t, a;
  // Derivatives of the shape functions along t and a.
  const Eigen::Matrix<double, 8, 2> slopes = shape.derivatives * (frame.transpose() * tangents).inverse();
  const double nu = material.poissons_ratio;
  const double plane = material.youngs_modulus / (1 - nu * nu), shear = material.youngs_modulus / (2 * (1 + nu));
  Eigen::Matrix<double, 24, 3> result;
  for (int i = 0; i < 8; ++i) {
    result.middleRows<3>(3 * i) << plane * (slopes(i, 0) * t + nu * slopes(i, 1) * a), plane * (slopes(i, 1) * a + nu * slopes(i, 0) * t),
        shear * (slopes(i, 1) * t + slopes(i, 0) * a);
  }
  return result;
}

}  // namespace

/// The fillet's faces: layer by layer, from its start down.
struct FilletStress::Layout {
  std::size_t layers, elements;
  Eigen::Matrix2Xd profile;
  std::vector<double> ends, stations, heights;  ///< stations: along the fillet; both of Gauss points

  explicit Layout(const GearMesh& mesh)
      : layers(mesh.planes.size() - 1),
        elements(mesh.surfaces(0).fillet.size() / layers),
        profile(2, 2 * static_cast<Eigen::Index>(elements) + 1),
        ends{0} {
    const std::vector<MeshFace>& faces = mesh.surfaces(0).fillet;
    const double turn = std::tan(mesh.form.helix_angle()) / mesh.form.reference_radius() * mesh.face_width / 2;
    const Eigen::Rotation2Dd back(turn);
    for (std::size_t i = 0; i < elements; ++i) {
      const auto first = 2 * static_cast<Eigen::Index>(i);
      const int edge[] = {faces[i][0], faces[i][4], faces[i][1]};
      for (int k = 0; k < 3; ++k) profile.col(first + k) = back * mesh.solid.nodes.col(edge[k]).head<2>();
      const EdgeNodes nodes = profile.middleCols<3>(first);
      for (const double xi : gauss2_abscissae) stations.push_back(ends.back() + arc_length(nodes, xi));
      ends.push_back(ends.back() + arc_length(nodes, 1));
    }
    for (double& station : stations) station /= ends.back();
    for (std::size_t layer = 0; layer < layers; ++layer) {
      const double middle = (mesh.planes[layer] + mesh.planes[layer + 1]) / 2;
      const double half = (mesh.planes[layer + 1] - mesh.planes[layer]) / 2;
      for (const double eta : gauss2_abscissae) heights.push_back(middle + eta * half);
    }
  }
};

FilletStress::FilletStress(const GearMesh& mesh, const Material& material) : FilletStress(mesh, material, Layout(mesh)) {}

FilletStress::FilletStress(const GearMesh& mesh, const Material& material, const Layout& layout)
    : half_width_(mesh.face_width / 2), profile_(layout.profile), ends_(layout.ends), along_(layout.stations), z_(layout.heights) {
  check_elastic(material);
  const std::vector<MeshFace>& faces = mesh.surfaces(0).fillet;
  const std::size_t elements = layout.elements;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t layer = 0; layer < layout.layers; ++layer) {
    for (std::size_t i = 0; i < elements; ++i) {
      const MeshFace& face = faces[layer * elements + i];
      const FaceNodes nodes = mesh.face_nodes(face);
      for (std::size_t point = 0; point < 4; ++point) {
        const auto station = static_cast<int>((2 * layer + point / 2) * 2 * elements + 2 * i + point % 2);
        const Eigen::Matrix<double, 24, 3> stress = face_stress(nodes, gauss2_abscissae[point % 2], gauss2_abscissae[point / 2], material);
        for (int row = 0; row < 24; ++row) {
          for (int c = 0; c < 3; ++c) entries.emplace_back(3 * face[row / 3] + row % 3, 3 * station + c, stress(row, c));
        }
      }
    }
  }
  at_gauss_.resize(mesh.solid.nodes.size(), 3 * along_.size() * z_.size());
  at_gauss_.setFromTriplets(entries.begin(), entries.end());
}

double FilletStress::along(const ProfilePoint& point) const {
  // The mesh has the right-hand profile, y up, as ToothForm.
  const Eigen::Vector2d wanted(point.x, point.y);
  constexpr int kParts = 64;  // of an element's half; between them along the chord
  double nearest = INFINITY, found = 0;
  for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
    const EdgeNodes edge = profile_.middleCols<3>(2 * static_cast<Eigen::Index>(i));
    const auto at = [&](double x) -> Eigen::Vector2d { return edge * EdgeShape(x).values; };
    for (int k = -kParts; k < kParts; ++k) {
      const double begin = static_cast<double>(k) / kParts, step = 1.0 / kParts;
      const Eigen::Vector2d from = at(begin), chord = at(begin + step) - from;
      const double t = std::clamp(chord.dot(wanted - from) / chord.squaredNorm(), 0.0, 1.0);
      const double distance = (from + t * chord - wanted).norm();
      if (distance < nearest) {
        nearest = distance;
        found = ends_[i] + arc_length(edge, begin + t * step);
      }
    }
  }
  return found / length();
}

Eigen::SparseMatrix<double> FilletStress::functionals(const std::vector<FilletPoint>& places) const {
  const Eigen::Index n = along_.size();
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const FilletPoint& place = places[p];
    if (!(place.along >= 0 && place.along <= 1)) {
      throw InvalidInput("place.along", std::to_string(place.along), "0 to 1");
    }
    if (!(std::abs(place.z) <= half_width_ * (1 + 1e-9))) {  // round-off of sums
      throw InvalidInput("place.z", std::to_string(place.z), "on the face, at most " + std::to_string(half_width_));
    }
    const Eigen::VectorXd s = along_.weights(place.along), z = z_.weights(place.z);
    for (Eigen::Index j = 0; j < z.size(); ++j) {
      for (Eigen::Index i = 0; i < n; ++i) {
        const double weight = s[i] * z[j];
        if (weight == 0) continue;
        for (int c = 0; c < 3; ++c) {
          entries.emplace_back(static_cast<int>(3 * (j * n + i)) + c, static_cast<int>(3 * p) + c, weight);
        }
      }
    }
  }
  Eigen::SparseMatrix<double> weights(at_gauss_.cols(), 3 * static_cast<Eigen::Index>(places.size()));
  weights.setFromTriplets(entries.begin(), entries.end());
  return at_gauss_ * weights;
}

PrincipalStress largest_principal(const Eigen::Vector3d& stress) {
  const double half = (stress[0] - stress[1]) / 2, radius = std::hypot(half, stress[2]);
  const double angle = radius > 0 ? std::atan2(stress[2], half) / 2 : 0;
  return {(stress[0] + stress[1]) / 2 + radius, {std::cos(angle), std::sin(angle)}};
}

Eigen::RowVector3d principal_slope(const PrincipalStress& principal) {
  const Eigen::Vector2d& v = principal.direction;
  return {v[0] * v[0], v[1] * v[1], 2 * v[0] * v[1]};
}

}  // namespace flankwright
