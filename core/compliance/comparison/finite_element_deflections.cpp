#include "core/compliance/comparison/finite_element_deflections.hpp"

#include <algorithm>
#include <cassert>

#include "core/compliance/tooth_places.hpp"

namespace flankwright {

/// Loads solved for at a time: enough for the factor to be read seldom, few enough to need little memory.
constexpr Eigen::Index kBlock = 32;

std::vector<FlankPoint> flank_points(const GearMesh& mesh, std::span<const FlankPlace> places) {
  std::vector<FlankPoint> points;
  for (const FlankPlace& place : places) {
    require_on_flank(place, mesh.face_width / mesh.normal_module);
    const double z = place.zeta * mesh.normal_module - mesh.face_width / 2;
    points.push_back({place.tooth, flank_radius(mesh.form, place.u), std::min(z, mesh.face_width / 2)});
  }
  return points;
}

Eigen::MatrixXd finite_element_deflections(const InfluenceModel& model, std::span<const FlankPlace> places,
                                           std::span<const FlankPlace> loads, RemovedMotion removed,
                                           const LoadProgress& progress) {
  assert(model.solid().status() == FactorStatus::Factorised);
  const GearMesh& mesh = model.mesh();
  const Eigen::SparseMatrix<double> rows = net_functionals(mesh, flank_points(mesh, places), removed);
  const Eigen::SparseMatrix<double> columns = net_functionals(mesh, flank_points(mesh, loads), removed);
  const double scale = model.material().youngs_modulus * mesh.normal_module;
  Eigen::MatrixXd K(rows.cols(), columns.cols());
  for (Eigen::Index first = 0; first < columns.cols(); first += kBlock) {
    const Eigen::Index count = std::min(kBlock, columns.cols() - first);
    K.middleCols(first, count) = scale * (rows.transpose() * model.solid().solve(columns.middleCols(first, count)));
    if (progress) progress(static_cast<int>(first + count), static_cast<int>(columns.cols()));
  }
  K.array() += scale * axial_hold_compliance(mesh, model.material(), removed);
  return K;
}

}  // namespace flankwright
