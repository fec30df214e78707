#include "core/compliance/finite_element/influence.hpp"

#include <chrono>

namespace flankwright {
namespace {

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Eigen::SparseMatrix<double> net_functionals(const GearMesh& mesh, const std::vector<FlankPoint>& points,
                                            RemovedMotion removed) {
  Eigen::SparseMatrix<double> result(mesh.solid.nodes.size(), static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::SparseVector<double> column = net_functional(mesh, points[i], removed);
    result.startVec(static_cast<Eigen::Index>(i));
    for (Eigen::SparseVector<double>::InnerIterator entry(column); entry; ++entry) {
      result.insertBack(entry.index(), static_cast<Eigen::Index>(i)) = entry.value();
    }
  }
  result.finalize();
  return result;
}

InfluenceModel::InfluenceModel(const GearToMesh& gear, const Material& material, const GearMeshOptions& options)
    : material_(material),
      started_(clock_seconds()),
      mesh_(gear_mesh(gear, options)),
      solid_(mesh_.solid, material, mesh_.supports),
      model_seconds_(clock_seconds() - started_) {}

InfluenceMatrix InfluenceModel::influence(const std::vector<FlankPoint>& points, RemovedMotion removed) const {
  InfluenceMatrix result;
  result.status = solid_.status();
  result.points = points;
  result.statistics.bricks = mesh_.solid.bricks.cols();
  result.statistics.unknowns = solid_.unknowns();
  result.statistics.factor_entries = static_cast<double>(solid_.factor().factor_entries());
  result.statistics.peak_bytes = static_cast<double>(solid_.factor().peak_bytes());
  result.statistics.model_seconds = model_seconds_;
  if (result.status != FactorStatus::Factorised) return result;
  const double start = clock_seconds();
  result.compliance = solid_.influence(net_functionals(mesh_, points, removed));
  result.compliance.array() += axial_hold_compliance(mesh_, material_, removed);
  result.statistics.solve_seconds = clock_seconds() - start;
  return result;
}

}  // namespace flankwright
