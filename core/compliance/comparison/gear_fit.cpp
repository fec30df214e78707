#include "core/compliance/comparison/gear_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/compliance/comparison/finite_element_deflections.hpp"
#include "core/compliance/tooth/station_grid.hpp"
#include "core/compliance/plate/cantilever_plate.hpp"
#include "core/compliance/thin_slice/thin_slice_tooth.hpp"

namespace flankwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// us x zetas; zetas run fastest.
struct Stations {
  std::vector<double> us, zetas;
  int count() const { return static_cast<int>(us.size() * zetas.size()); }
};

std::vector<FlankStation> on_tooth(const Stations& stations, int tooth) {
  std::vector<FlankStation> list;
  for (const double u : stations.us) {
    for (const double zeta : stations.zetas) list.push_back({tooth, u, zeta});
  }
  return list;
}

std::vector<double> centres(const std::vector<double>& nodes) {
  std::vector<double> between;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) between.push_back(0.5 * (nodes[i] + nodes[i + 1]));
  return between;
}

/// Leaves out pairs with hardly any coupling, K near zero beside sqrt(K_pp K_qq): the thesis' forms cannot pass through
/// zero as the values do, and relative residuals of these pairs would dominate the fit.
std::vector<InfluenceSample> without_faint_pairs(std::vector<InfluenceSample> samples) {
  constexpr double kFaint = 0.01;
  for (InfluenceSample& sample : samples) {
    const Eigen::VectorXd own = sample.compliance.diagonal();
    for (Index p = 0; p < own.size(); ++p) {
      for (Index q = 0; q < own.size(); ++q) {
        double& K = sample.compliance(p, q);
        if (std::abs(K) < kFaint * std::sqrt(own[p] * own[q])) K = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  return samples;
}

Stations cells_of(const Stations& grid) { return {centres(grid.us), centres(grid.zetas)}; }

Stations own_stations(double face, int radii) {
  const StationGrid grid = station_grid(face, radii);
  return {grid.us(), grid.zetas()};
}

/// Every second axial station, with both ends.
Stations adjacent_stations(double face, int radii) {
  Stations stations = own_stations(face, radii);
  std::vector<double> kept;
  for (std::size_t i = 0; i + 1 < stations.zetas.size(); i += 2) kept.push_back(stations.zetas[i]);
  kept.push_back(stations.zetas.back());
  stations.zetas = kept;
  return stations;
}

/// Runs one gear; each step adds to the result.
class GearFitRun {
 public:
  GearFitRun(const GearFitTask& task, const FitProgress& progress) : task_(task), progress_(progress) {
    if (task.radii < 4 || task.adjacent_radii < 4) {
      throw InvalidInput("fit.radii", std::to_string(std::min(task.radii, task.adjacent_radii)), "4 or more");
    }
    if (task.teeth_apart < 1 || task.teeth_apart > task.mesh.teeth_each_side) {
      throw InvalidInput("fit.teeth_apart", std::to_string(task.teeth_apart),
                         "1 .. " + std::to_string(task.mesh.teeth_each_side) + ", the teeth meshed on either side");
    }
    apart_ = task.form.couples_teeth() ? task.teeth_apart : 0;
    const GearToMesh& gear = task.gear;
    result_.gear = {gear.gear.teeth, gear.helix_angle, gear.gear.face_width / gear.normal_module, gear.gear.profile_shift};
    result_.body = gear.body;
    result_.removed = task.removed;
  }

  GearFitResult finish() {
    report("meshing and factorising", 0, 1);
    const InfluenceModel model(task_.gear, task_.material, task_.mesh);
    report("meshing and factorising", 1, 1);
    result_.finite_elements = model.influence({}, task_.removed).statistics;
    result_.status = model.solid().status();
    result_.times.model = result_.finite_elements.model_seconds;
    if (result_.status != FactorStatus::Factorised) return std::move(result_);

    const Stopwatch loads;
    solve(model);
    result_.times.loads = result_.finite_elements.solve_seconds = loads.seconds();
    const Stopwatch fit;
    report("fitting", 0, 1);
    result_.fit = fit_compliance(fitted_, task_.form, task_.fit);
    report("fitting", 1, 1);
    result_.times.fit = fit.seconds();
    const Stopwatch others;
    compare(model);
    result_.times.others = others.seconds();
    return std::move(result_);
  }

 private:
  void report(const std::string& label, int done, int total) const {
    if (progress_) progress_(label, done, total);
  }

  /// Samples of one grid on the loaded tooth and one on several.
  std::vector<InfluenceSample> samples(const InfluenceModel& model, const Stations& own, const Stations& adjacent) {
    report("solving loads", result_.loads, total_loads_);
    std::vector<InfluenceSample> all = finite_element_samples(model, result_.gear, own.us, own.zetas, 0, task_.removed);
    result_.loads += own.count();
    if (apart_ == 0) return all;
    std::vector<InfluenceSample> several = finite_element_samples(model, result_.gear, adjacent.us, adjacent.zetas, apart_, task_.removed);
    result_.loads += adjacent.count();
    all.insert(all.end(), several.begin() + 1, several.end());
    return all;
  }

  void solve(const InfluenceModel& model) {
    const double face = result_.gear.relative_face;
    const Stations own = own_stations(face, task_.radii);
    adjacent_ = adjacent_stations(face, task_.adjacent_radii);
    const Stations own_cells = cells_of(own), adjacent_cells = cells_of(adjacent_);
    total_loads_ = own.count() + (apart_ > 0 ? adjacent_.count() : 0);
    if (task_.test_grid) total_loads_ += own_cells.count() + (apart_ > 0 ? adjacent_cells.count() : 0);
    fitted_ = samples(model, own, adjacent_);
    if (task_.test_grid) unseen_ = samples(model, own_cells, adjacent_cells);
  }

  void add_residuals(const std::string& form, FitStatus status, const FlankCompliance* model, int known_apart) {
    FormResiduals residuals{form, status, {}, {}};
    if (model != nullptr) {
      residuals.fitted = residual_distributions(*model, known_apart, fitted_);
      residuals.unseen = residual_distributions(*model, known_apart, unseen_);
    }
    result_.residuals.push_back(std::move(residuals));
  }

  void compare(const InfluenceModel& model) {
    report("comparing", 0, 3);
    const GearToMesh& gear = task_.gear;
    const double nu = task_.material.poissons_ratio;
    const auto& fit = result_.fit.fit;
    add_residuals("kernels", result_.fit.status, fit ? &*fit : nullptr, apart_);
    std::optional<ThesisCompliance> thesis;
    const std::vector<InfluenceSample> for_thesis = without_faint_pairs(fitted_);
    for (const ThesisBody body : {ThesisBody::InMasterFunction, ThesisBody::Separate}) {
      ThesisFitResult other = fit_thesis_form(for_thesis, body);
      add_residuals(body == ThesisBody::Separate ? "thesis_separate" : "thesis_in_master", other.status, other.fit ? &*other.fit : nullptr, apart_);
      thesis = std::move(other.fit);
    }
    report("comparing", 1, 3);
    const CantileverPlate plate(model.mesh().form, gear.normal_module, gear.gear.face_width, nu);
    const ThinSliceTooth slices(model.mesh().form, gear.normal_module, gear.gear.face_width, nu);
    std::vector<NamedModel> models{
        {"finite elements", task_.mesh.teeth_each_side, [&](std::span<const FlankStation> stations, std::span<const FlankStation> loads) {
           return finite_element_deflections(model, stations, loads, task_.removed);
         }}};
    if (fit) models.push_back(named_model("fitted", apart_, *fit));
    if (thesis) models.push_back(named_model("thesis", apart_, *thesis));
    models.push_back(named_model("plate", 0, plate));
    models.push_back(named_model("thin slices", 0, slices));
    result_.curves = gear_deflection_curves(models, result_.gear.relative_face, task_.teeth_apart);
    report("comparing", 2, 3);
    if (fit) find_lowest_eigenvalue(*fit);
    report("comparing", 3, 3);
  }

  void find_lowest_eigenvalue(const FittedCompliance& fit) {
    // Defined and semi-definite over any teeth, though only so many were compared with finite elements.
    FitRecord record = fit.record();
    if (apart_ > 0) record.range.teeth_apart = 4;
    const FittedCompliance everywhere(fit.form(), fit.gear(), fit.coefficients(), record);
    std::vector<FlankStation> stations;
    for (int tooth = 0; tooth <= record.range.teeth_apart; ++tooth) {
      const std::vector<FlankStation> some = on_tooth(adjacent_, tooth);
      stations.insert(stations.end(), some.begin(), some.end());
    }
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(everywhere.evaluate(stations), Eigen::EigenvaluesOnly).eigenvalues();
    result_.lowest_eigenvalue = values.minCoeff() / values.maxCoeff();
    result_.eigenvalue_teeth = record.range.teeth_apart + 1;
  }

  const GearFitTask& task_;
  const FitProgress& progress_;
  GearFitResult result_;
  int apart_{0};  ///< pitches over which the form couples teeth
  int total_loads_{0};
  Stations adjacent_;
  std::vector<InfluenceSample> fitted_, unseen_;
};

}  // namespace

std::vector<InfluenceSample> finite_element_samples(const InfluenceModel& model, const GearProportions& gear, const std::vector<double>& us,
                                                    const std::vector<double>& zetas, int teeth_apart, RemovedRigidMotion removed) {
  const Stations grid{us, zetas};
  const std::vector<FlankStation> loads = on_tooth(grid, 0);
  std::vector<FlankStation> stations;
  for (int tooth = -teeth_apart; tooth <= teeth_apart; ++tooth) {
    const std::vector<FlankStation> some = on_tooth(grid, tooth);
    stations.insert(stations.end(), some.begin(), some.end());
  }
  const MatrixXd K = finite_element_deflections(model, stations, loads, removed);
  const auto n = static_cast<Index>(loads.size());
  const auto of_tooth = [&](int m) { return K.middleRows((teeth_apart + m) * n, n); };
  const MatrixXd own = 0.5 * (of_tooth(0) + of_tooth(0).transpose());

  std::vector<InfluenceSample> samples{{gear, loads, own}};
  for (int m = 1; m <= teeth_apart; ++m) {
    InfluenceSample pair{gear, loads, MatrixXd(2 * n, 2 * n)};
    const std::vector<FlankStation> there = on_tooth(grid, m);
    pair.points.insert(pair.points.end(), there.begin(), there.end());
    // Row: tooth 0, column: tooth m. Deflection of tooth -m under loads on tooth 0, and the other way round.
    const MatrixXd across = 0.5 * (of_tooth(-m) + of_tooth(m).transpose());
    // The loaded tooth's own pairs once, among those of m = 1; diagonal values everywhere, as small values are judged
    // by them.
    MatrixXd same = own;
    if (m > 1) {
      same.setConstant(std::numeric_limits<double>::quiet_NaN());
      same.diagonal() = own.diagonal();
    }
    pair.compliance << same, across, across.transpose(), same;
    samples.push_back(std::move(pair));
  }
  return samples;
}

GearFitResult fit_gear(const GearFitTask& task, const FitProgress& progress) { return GearFitRun(task, progress).finish(); }

}  // namespace flankwright
