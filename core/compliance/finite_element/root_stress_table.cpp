#include "core/compliance/finite_element/root_stress_table.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "core/base/units.hpp"
#include "core/compliance/tooth_places.hpp"

namespace flankwright {

Eigen::MatrixXd RootStressTable::evaluate(int tooth, std::span<const FlankPlace> forces) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * fillet.size(), static_cast<Eigen::Index>(forces.size()));
  // All forces on one tooth together: a product of matrices reads its table once.
  for (std::size_t begin = 0, end = 0; begin < forces.size(); begin = end) {
    while (end < forces.size() && forces[end].tooth == forces[begin].tooth) ++end;
    const int apart = forces[begin].tooth - tooth;
    if (std::abs(apart) > teeth_each_side()) continue;
    Eigen::MatrixXd weights(grid.size(), static_cast<Eigen::Index>(end - begin));
    for (std::size_t i = begin; i < end; ++i) weights.col(static_cast<Eigen::Index>(i - begin)) = grid.weights(forces[i]);
    result.middleCols(static_cast<Eigen::Index>(begin), weights.cols()).noalias() =
        stress[static_cast<std::size_t>(apart + teeth_each_side())] * weights;
  }
  return result;
}

std::vector<double> fillet_zetas(double face_width) {
  return axial_places(face_width, {0.25, 0.4, 0.6});
}

FilletGrid fillet_grid(const GearMesh& mesh, const FilletStress& fillet) {
  const double tangent = fillet.along(mesh.form.root_tangent_point(30 * units::deg));
  FilletGrid grid;
  for (int i = 1; i <= fillet_stations; ++i) grid.along.push_back(0.1 * (i + 1));
  const auto nearest = std::ranges::min_element(grid.along, {}, [&](double s) { return std::abs(s - tangent); });
  *nearest = tangent;
  grid.tangent = static_cast<std::size_t>(nearest - grid.along.begin());
  grid.zetas = fillet_zetas(mesh.face_width / mesh.normal_module);
  return grid;
}

RootStressReadings root_stress_readings(const GearMesh& mesh, const Material& material) {
  const FilletStress fillet(mesh, material);
  const FilletGrid grid = fillet_grid(mesh, fillet);
  std::vector<FilletPlace> places;
  for (const double along : grid.along) {
    for (const double zeta : grid.zetas) places.push_back({along, zeta * mesh.normal_module - mesh.face_width / 2});
  }
  return {grid, fillet.functionals(places)};
}

RootStressTable root_stress_table(const GearMesh& mesh, const FlankGrid& grid, const FilletGrid& fillet, const Eigen::MatrixXd& stress) {
  assert(stress.rows() == 3 * fillet.size() && stress.cols() == (2 * mesh.teeth_each_side + 1) * grid.size());
  RootStressTable table{grid, fillet, {}};
  const double scale = mesh.normal_module * mesh.normal_module;
  for (Eigen::Index begin = 0; begin < stress.cols(); begin += grid.size()) table.stress.push_back(scale * stress.middleCols(begin, grid.size()));
  return table;
}

}  // namespace flankwright
