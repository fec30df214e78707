#include "core/compliance/finite_element/influence.hpp"

#include <chrono>
#include <utility>

namespace flankwright {

Functionals side_by_side(std::initializer_list<const Functionals*> parts, Eigen::Index rows) {
  Eigen::Index columns = 0, entries = 0;
  for (const Functionals* part : parts) {
    columns += part->cols();
    entries += part->nonZeros();
  }
  Functionals result(rows, columns);
  result.reserve(entries);
  Eigen::Index at = 0;
  for (const Functionals* part : parts) {
    for (Eigen::Index column = 0; column < part->cols(); ++column, ++at) {
      result.startVec(at);
      for (Functionals::InnerIterator entry(*part, column); entry; ++entry) result.insertBack(entry.row(), at) = entry.value();
    }
  }
  result.finalize();
  return result;
}

namespace {

double clock_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

FlankFunctionals::FlankFunctionals(const GearMesh& mesh, const std::vector<FlankPoint>& flank, RemovedRigidMotion removed,
                                   const Eigen::SparseMatrix<double>& more) {
  NetFunctionals net = net_functionals(mesh, flank, removed);
  taken_off.swap(net.taken_off);
  points = net.centre.cols();
  motions = net.motions.cols();
  readings = more.cols();
  all = side_by_side({&net.centre, &net.motions, &more}, net.centre.rows());
}

FlankInfluence FlankFunctionals::influence(const Eigen::MatrixXd& gram, double hold) const {
  const Eigen::Index n = points, m = motions, r = readings;
  const Eigen::MatrixXd by_motions = gram.middleRows(n, m).leftCols(n) - gram.block(n, n, m, m) * taken_off;
  Eigen::MatrixXd compliance = gram.topLeftCorner(n, n) - gram.block(0, n, n, m) * taken_off - taken_off.transpose() * by_motions;
  compliance = (0.5 * (compliance + compliance.transpose())).eval();
  return {compliance.array() + hold, gram.bottomLeftCorner(r, n) - gram.block(n + m, n, r, m) * taken_off, gram.bottomRightCorner(r, r)};
}

FlankInfluence solve_flank_influence(const GearMesh& mesh, const SolidModel& solid, const Material& material, const std::vector<FlankPoint>& points,
                                     RemovedRigidMotion removed, const Eigen::SparseMatrix<double>& readings) {
  FlankFunctionals functionals(mesh, points, removed, readings);
  return functionals.influence(solid.influence(functionals.all), axial_hold_compliance(mesh, material, removed));
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
