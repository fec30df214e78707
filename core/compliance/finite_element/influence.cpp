#include "core/compliance/finite_element/influence.hpp"

#include <chrono>
#include <utility>

namespace flankwright {
namespace {

double clock_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

FlankInfluence solve_flank_influence(const GearMesh& mesh, const SolidModel& solid, const Material& material, const std::vector<FlankPoint>& points,
                                     RemovedRigidMotion removed, const Eigen::SparseMatrix<double>& readings) {
  NetFunctionals net = net_functionals(mesh, points, removed);
  const Eigen::SparseMatrix<double> T = std::move(net.taken_off);
  const Eigen::Index n = net.centre.cols(), m = net.motions.cols(), r = readings.cols();
  Eigen::SparseMatrix<double> parts = std::move(net.centre);
  parts.conservativeResize(parts.rows(), n + m + r);
  if (m > 0) parts.middleCols(n, m) = net.motions;
  if (r > 0) parts.rightCols(r) = readings;
  const Eigen::MatrixXd G = solid.influence(std::move(parts));  // of centre, motions and readings

  const Eigen::MatrixXd motions = G.middleRows(n, m).leftCols(n) - G.block(n, n, m, m) * T;
  Eigen::MatrixXd compliance = G.topLeftCorner(n, n) - G.block(0, n, n, m) * T - T.transpose() * motions;
  compliance = (0.5 * (compliance + compliance.transpose())).eval();
  return {compliance.array() + axial_hold_compliance(mesh, material, removed), G.bottomLeftCorner(r, n) - G.block(n + m, n, r, m) * T};
}

InfluenceModel::InfluenceModel(const GearToMesh& gear, const Material& material, const GearMeshOptions& options)
    : material_(material),
      started_(clock_seconds()),
      mesh_(gear_mesh(gear, options)),
      solid_(mesh_.solid, material, mesh_.supports),
      model_seconds_(clock_seconds() - started_) {}

InfluenceMatrix InfluenceModel::influence(const std::vector<FlankPoint>& points, RemovedRigidMotion removed) const {
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
  result.compliance = solve_flank_influence(mesh_, solid_, material_, points, removed).compliance;
  result.statistics.solve_seconds = clock_seconds() - start;
  return result;
}

}  // namespace flankwright
