#include "core/compliance/finite_element/root_stress_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/finite_element/influence.hpp"
#include "core/compliance/tooth_places.hpp"

namespace flankwright {
namespace {

FlankPoint point_of(const GearMesh& mesh, const FlankPlace& place) {
  return {place.tooth, flank_radius(mesh.form, place.u), place.zeta * mesh.normal_module - mesh.face_width / 2};
}

}  // namespace

Eigen::MatrixXd RootStressTable::evaluate(int tooth, std::span<const FlankPlace> forces) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * fillet.size(), static_cast<Eigen::Index>(forces.size()));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const int apart = forces[i].tooth - tooth;
    if (std::abs(apart) > teeth_each_side()) continue;
    const Eigen::MatrixXd& table = stress[static_cast<std::size_t>(apart + teeth_each_side())];
    result.col(static_cast<Eigen::Index>(i)) = table * grid.weights(forces[i]);
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

RootStressTable solve_root_stress_table(const GearMesh& mesh, const SolidModel& solid, const Material& material,
                                        const FlankGrid& grid,
                                        const std::function<void(Eigen::Index, Eigen::Index)>& progress) {
  const double width = mesh.face_width / mesh.normal_module;
  if (!(std::abs(grid.face_width() - width) <= 1e-9 * width)) {  // round-off of the division
    throw InvalidInput("grid", std::to_string(grid.face_width()) + " modules", std::to_string(width));
  }
  const FilletStress fillet(mesh, material);
  RootStressTable table{grid, fillet_grid(mesh, fillet), {}};
  std::vector<FilletPlace> places;
  for (const double along : table.fillet.along) {
    for (const double zeta : table.fillet.zetas)
      places.push_back({along, zeta * mesh.normal_module - mesh.face_width / 2});
  }
  std::vector<FlankPoint> points;
  for (int tooth = -mesh.teeth_each_side; tooth <= mesh.teeth_each_side; ++tooth) {
    for (const FlankPlace& place : grid.places(tooth)) points.push_back(point_of(mesh, place));
  }
  const Eigen::SparseMatrix<double> forces = net_functionals(mesh, points, RemovedMotion::TranslationTorsionAndTilt);
  const Eigen::SparseMatrix<double> readings = fillet.functionals(places);
  const double scale = mesh.normal_module * mesh.normal_module;
  Eigen::MatrixXd stress(readings.cols(), forces.cols());
  for (Eigen::Index begin = 0; begin < readings.cols(); begin += kSolveBlock) {
    const Eigen::Index rows = std::min(kSolveBlock, readings.cols() - begin);
    stress.middleRows(begin, rows) =
        scale * (forces.transpose() * solid.solve(readings.middleCols(begin, rows))).transpose();
    if (progress) progress(begin + rows, readings.cols());
  }
  for (Eigen::Index begin = 0; begin < forces.cols(); begin += grid.size()) {
    table.stress.push_back(stress.middleCols(begin, grid.size()));
  }
  return table;
}

}  // namespace flankwright
