#include "core/compliance/finite_element/solve_influence_table.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/base/taken.hpp"
#include "core/contact/path/path_of_contact.hpp"

namespace flankwright {
namespace {

/// The stations on all detailed teeth, one tooth after the other: those of the grid on tooth 0, those of the neighbours' grid on the others.
class TeethStations {
 public:
  explicit TeethStations(const InfluenceTableTask& task) : task_(task) {
    const StationGrid& neighbours = task.grid_of_neighbours();
    onto_grid_.resize(task.grid.size(), neighbours.size());
    Eigen::Index row = 0;
    for (const FlankStation& station : task.grid.stations()) onto_grid_.row(row++) = neighbours.weights(station);
  }

  std::vector<FlankPoint> points(const GearMesh& mesh) const {
    const ToothForm& form = mesh.form;
    std::vector<FlankPoint> result;
    for (int tooth = -task_.teeth_apart; tooth <= task_.teeth_apart; ++tooth) {
      for (const FlankStation& station : (tooth == 0 ? task_.grid : task_.grid_of_neighbours()).stations(tooth)) {
        result.push_back(
            {tooth, form.form_radius() + (station.u + 1) / 2 * (form.tip_radius() - form.form_radius()), station.zeta - mesh.face_width / 2});
      }
    }
    return result;
  }

  /// Number of stations before those of a tooth.
  Eigen::Index first(int tooth) const {
    const Eigen::Index before = (task_.teeth_apart + tooth) * onto_grid_.cols();
    return tooth > 0 ? before - onto_grid_.cols() + onto_grid_.rows() : before;
  }

  /// Columns at the stations of every tooth, interpolated to the grid on the neighbours.
  Eigen::MatrixXd on_grid(const Eigen::MatrixXd& columns) const {
    const Eigen::Index n = onto_grid_.rows(), n_neighbour = onto_grid_.cols();
    Eigen::MatrixXd result(columns.rows(), (2 * task_.teeth_apart + 1) * n);
    for (int tooth = -task_.teeth_apart; tooth <= task_.teeth_apart; ++tooth) {
      auto of_tooth = result.middleCols((task_.teeth_apart + tooth) * n, n);
      if (tooth == 0) {
        of_tooth = columns.middleCols(first(tooth), n);
      } else {
        of_tooth = columns.middleCols(first(tooth), n_neighbour) * onto_grid_.transpose();
      }
    }
    return result;
  }

 private:
  const InfluenceTableTask& task_;
  Eigen::MatrixXd onto_grid_;  ///< weights of the neighbours' stations in the values at those of the grid
};

}  // namespace

InfluenceTableTask in_modules(InfluenceTableTask task) {
  GearToMesh& gear = task.gear;
  const double module = gear.normal_module;
  gear.gear = as_generated(gear.gear, module, gear.pressure_angle);
  for (double* length : {&gear.gear.face_width, &gear.gear.tip_diameter, &gear.normal_module}) *length /= module;
  gear.body = in_units(gear.body, module);
  return task;
}

bool alike_but_for_size(const InfluenceTableTask& one, const InfluenceTableTask& other) {
  const InfluenceTableTask a = in_modules(one), b = in_modules(other);
  const auto fields = [](const InfluenceTableTask& task) {
    const GearToMesh& gear = task.gear;
    return std::tie(gear.gear.teeth, gear.gear.face_width, gear.gear.profile_shift, gear.gear.tip_diameter, gear.gear.rack, gear.pressure_angle,
                    gear.helix_angle, gear.body, task.poissons_ratio, task.teeth_apart, task.mesh, task.removed, task.root_stress, task.grid.us(),
                    task.grid.zetas(), task.grid_of_neighbours().us(), task.grid_of_neighbours().zetas());
  };
  return fields(a) == fields(b);
}

bool reads_rim_motion(const GearBody& body) { return body.web && !body.rigid; }

int teeth_apart_in_contact(const GearPair& pair) { return static_cast<int>(std::floor(PathOfContact(pair).last_line_phase())); }

namespace {

/// Solves into a run, which holds what was done before an allocation fails.
class TableSolver {
 public:
  TableSolver(const InfluenceTableTask& task, const TableProgress& progress, InfluenceTableRun& run) : task_(task), progress_(progress), run_(run) {}

  void solve(double memory_limit, const ForEachIndex& for_each) {
    report(0);
    const Stopwatch clock;
    GearMeshOptions options = task_.mesh;
    options.teeth_each_side = task_.teeth_apart;
    const GearMesh mesh = gear_mesh(in_modules(task_).gear, options);
    RunStatistics& statistics = run_.statistics;
    statistics.bricks = mesh.solid.bricks.cols();
    const Material material{1, task_.poissons_ratio};
    SolidStiffness stiffness(mesh.solid, material, mesh.supports);
    statistics.unknowns = stiffness.lower.rows();
    // Where the matrix of the other gear is being ordered, the loads come first.
    EliminationOrder order(stiffness.lower, stiffness.node_of, EliminationOrder::Turn::Now);
    RootStressReadings roots = task_.root_stress ? root_stress_readings(mesh, material, task_.grid) : RootStressReadings{};
    const Eigen::Index of_stress = roots.stress.cols(), of_loads = roots.on_the_flank.cols();
    const bool has_rim = reads_rim_motion(task_.gear.body);
    Functionals readings;
    {  // what they are made of goes before the solution, which needs the memory
      const Functionals stress = taken(roots.stress), on_the_flank = taken(roots.on_the_flank), rim = has_rim ? rim_functionals(mesh) : Functionals();
      readings = side_by_side({&stress, &on_the_flank, &rim}, mesh.solid.nodes.size());
    }
    const TeethStations stations(task_);
    FlankFunctionals functionals(mesh, stations.points(mesh), task_.removed, taken(readings));
    const double model = clock.seconds();
    int last = 0;
    const auto progress = [&](double done) {
      const int step = kModelSteps + static_cast<int>(std::floor(done * (kTableSteps - kModelSteps - 1)));
      if (step > last) report(last = step);
    };
    const MultifrontalGram solved =
        influence_at_once(std::move(stiffness), std::move(functionals.all), memory_limit, progress, for_each, std::move(order));
    run_.status = solved.status;
    statistics.factor_entries = solved.factor_entries;
    statistics.peak_bytes = solved.peak_bytes;
    statistics.model_seconds = model + solved.analysis_seconds;
    if (run_.status != FactorStatus::Factorised) return;
    const FlankInfluence influence = functionals.influence(solved.gram, axial_hold_compliance(mesh, material, task_.removed));
    run_.table.emplace(task_.grid, tables(stations.on_grid(influence.compliance.middleRows(stations.first(0), task_.grid.size()))));
    if (has_rim) {
      run_.rim_motion =
          rim_motion_table(mesh, task_.grid, stations.on_grid(influence.readings.bottomRows(influence.readings.rows() - of_stress - of_loads)));
    }
    if (task_.root_stress) {
      run_.root_stress = root_stress_table(mesh, task_.grid, roots.fillet, stations.on_grid(influence.readings.topRows(of_stress)),
                                           influence.between_readings.block(0, of_stress, of_stress, of_loads));
    }
    statistics.solve_seconds = clock.seconds() - statistics.model_seconds;
    report(kTableSteps);
  }

 private:
  void report(int done) const {
    if (progress_) progress_(done, kTableSteps);
  }

  /// From the deflections of tooth 0 under loads on teeth -M .. M, which are those of these teeth under loads on tooth 0.
  std::vector<Eigen::MatrixXd> tables(const Eigen::MatrixXd& deflections) const {
    const Eigen::Index n = task_.grid.size();
    const auto by_tooth = [&](int m) { return deflections.middleCols((task_.teeth_apart + m) * n, n); };
    std::vector<Eigen::MatrixXd> result;
    for (int m = 0; m <= task_.teeth_apart; ++m) result.push_back(0.5 * (by_tooth(-m).transpose() + by_tooth(m)));
    return result;
  }

  const InfluenceTableTask& task_;
  const TableProgress& progress_;
  InfluenceTableRun& run_;
};

}  // namespace

InfluenceTableRun solve_influence_table(const InfluenceTableTask& task, double memory_limit, const TableProgress& progress,
                                        const ForEachIndex& for_each) {
  const double face_width = task.gear.gear.face_width / task.gear.normal_module;
  if (!(std::abs(task.grid.face_width() - face_width) <= 1e-9 * face_width)) {  // round-off of the division
    throw InvalidInput("grid", std::to_string(task.grid.face_width()) + " modules", std::to_string(face_width));
  }
  InfluenceTableRun run;
  try {
    TableSolver(task, progress, run).solve(memory_limit, for_each);
  } catch (const std::bad_alloc&) {
    run.status = FactorStatus::OutOfMemory;
    run.table.reset();
    run.root_stress.reset();
    run.rim_motion.reset();
  }
  return run;
}

}  // namespace flankwright
