#include "core/compliance/finite_element/root_stress_table.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "core/base/units.hpp"
#include "core/compliance/tooth/flank_stations.hpp"

namespace flankwright {

const Eigen::MatrixXd* RootStressTable::response(int tooth, int loaded_tooth) const {
  const int apart = loaded_tooth - tooth;
  return std::abs(apart) > teeth_each_side() ? nullptr : &stress[static_cast<std::size_t>(apart + teeth_each_side())];
}

std::vector<double> fillet_zetas(double face_width) { return axial_stations(face_width, {0.25, 0.4, 0.6}); }

FilletGrid fillet_grid(const GearMesh& mesh, const FilletStress& fillet) {
  const double tangent = fillet.along(mesh.form.root_tangent_point(30 * units::deg));
  FilletGrid grid;
  grid.along.assign(fillet_stations.begin(), fillet_stations.end());
  const auto nearest = std::ranges::min_element(grid.along, {}, [&](double s) { return std::abs(s - tangent); });
  *nearest = tangent;
  grid.tangent = static_cast<std::size_t>(nearest - grid.along.begin());
  grid.zetas = fillet_zetas(mesh.face_width / mesh.normal_module);
  return grid;
}

RootStressReadings root_stress_readings(const GearMesh& mesh, const Material& material) {
  const FilletStress fillet(mesh, material);
  const FilletGrid grid = fillet_grid(mesh, fillet);
  std::vector<FilletPoint> stations;
  for (const double along : grid.along) {
    for (const double zeta : grid.zetas) stations.push_back({along, zeta * mesh.normal_module - mesh.face_width / 2});
  }
  return {grid, fillet.functionals(stations)};
}

RootStressTable root_stress_table(const GearMesh& mesh, const StationGrid& grid, const FilletGrid& fillet, const Eigen::MatrixXd& stress) {
  assert(stress.rows() == 3 * fillet.size() && stress.cols() == (2 * mesh.teeth_each_side + 1) * grid.size());
  RootStressTable table{grid, fillet, {}};
  const double scale = mesh.normal_module * mesh.normal_module;
  for (Eigen::Index begin = 0; begin < stress.cols(); begin += grid.size()) table.stress.push_back(scale * stress.middleCols(begin, grid.size()));
  return table;
}

}  // namespace flankwright
