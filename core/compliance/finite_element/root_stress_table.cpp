#include "core/compliance/finite_element/root_stress_table.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "core/base/units.hpp"
#include "core/compliance/finite_element/load_functional.hpp"
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

RootStressReadings root_stress_readings(const GearMesh& mesh, const Material& material, const StationGrid& grid) {
  const FilletStress fillet(mesh, material);
  const FilletGrid places = fillet_grid(mesh, fillet);
  std::vector<FilletPoint> stations;
  for (const double along : places.along) {
    for (const double zeta : places.zetas) stations.push_back({along, zeta * mesh.normal_module - mesh.face_width / 2});
  }
  Eigen::SparseMatrix<double> on_the_flank(mesh.solid.nodes.size(), grid.size());
  Eigen::Index column = 0;
  for (const FlankStation& station : grid.stations()) {
    const FlankPoint point{0, flank_radius(mesh.form, station.u), station.zeta * mesh.normal_module - mesh.face_width / 2};
    const Eigen::SparseVector<double> load = flank_functional(mesh, point) - centre_functional(mesh, point);
    on_the_flank.startVec(column);
    for (Eigen::SparseVector<double>::InnerIterator entry(load); entry; ++entry) on_the_flank.insertBack(entry.index(), column) = entry.value();
    ++column;
  }
  on_the_flank.finalize();
  return {places, fillet.functionals(stations), on_the_flank};
}

RootStressTable root_stress_table(const GearMesh& mesh, const StationGrid& grid, const FilletGrid& fillet, const Eigen::MatrixXd& stress,
                                  const Eigen::MatrixXd& on_the_flank) {
  const Eigen::Index n = grid.size();
  assert(stress.rows() == 3 * fillet.size() && stress.cols() == (2 * mesh.teeth_each_side + 1) * n);
  assert(on_the_flank.rows() == stress.rows() && on_the_flank.cols() == n);
  RootStressTable table{grid, fillet, {}};
  const double scale = mesh.normal_module * mesh.normal_module;
  for (Eigen::Index begin = 0; begin < stress.cols(); begin += n) table.stress.push_back(scale * stress.middleCols(begin, n));
  table.stress[static_cast<std::size_t>(mesh.teeth_each_side)] += scale * on_the_flank;
  return table;
}

}  // namespace flankwright
