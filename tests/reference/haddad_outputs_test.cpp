#include "core/load/solve/load_solver.hpp"
#include "tests/reference/haddad_outputs.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <future>
#include <vector>

#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "core/compliance/local/hertz_line.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "tests/reference/haddad_18_54.hpp"
#include "tests/common/about.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
namespace haddad = reference::haddad_1991;

namespace {

const Material kMaterial{haddad::youngs_modulus, haddad::poissons_ratio};

std::shared_ptr<const InfluenceTable> influence_table(const GearPair& pair, Member member) {
  const PairData& data = pair.data;
  const GearToMesh gear{data[member], data.normal_module, data.pressure_angle, data.helix_angle, {}};
  const InfluenceTableTask task{.gear = gear,
                                .poissons_ratio = kMaterial.poissons_ratio,
                                .teeth_apart = teeth_apart_in_contact(pair),
                                .grid = station_grid(data[member].face_width / data.normal_module)};
  const InfluenceTableRun run = solve_influence_table(task, 16e9);
  REQUIRE(run.status == FactorStatus::Factorised);
  return std::make_shared<const InfluenceTable>(*run.table);
}

/// A sample output: its position of mesh, and per row of null_a or null_b error [um] and load.
struct Row {
  int tooth;
  double z, error, load;
};
struct PrintedOutput {
  const char* name;
  int position;
  double transmission_error;  // um
  std::vector<Row> rows;
};

std::vector<PrintedOutput> outputs() {
  const auto perfect = [](const char* name, int position, double f_t, const auto& points) {
    PrintedOutput output{name, position, f_t, {}};
    for (const haddad::Point& p : points) output.rows.push_back({p.tooth, p.z, 0.0, p.load});
    return output;
  };
  const auto with_errors = [](const char* name, const haddad::OutputWithErrors& printed, auto&& error) {
    PrintedOutput output{name, 0, printed.transmission_error, {}};
    for (std::size_t i = 0; i < haddad::null_a.size(); ++i) {
      const haddad::Point& p = haddad::null_a[i];
      output.rows.push_back({p.tooth, p.z, error(i), printed.loads[i]});
    }
    return output;
  };
  return {perfect("null-a", 0, haddad::transmission_error_a, haddad::null_a),
          perfect("null-b", 1, haddad::transmission_error_b, haddad::null_b),
          with_errors("1, helix slope", haddad::helix_slope_output, [](std::size_t i) { return haddad::errors[i].helix_slope; }),
          with_errors("2, lead crowning", haddad::lead_crowning_output, [](std::size_t i) { return haddad::errors[i].lead_crowning; }),
          with_errors("6, addendum crowning", haddad::addendum_crowning_output, [](std::size_t i) { return haddad::errors[i].addendum_crowning; }),
          with_errors("8, pitch", haddad::pitch_error_output,
                      [](std::size_t i) { return haddad::pitch_errors[static_cast<std::size_t>(haddad::null_a[i].tooth - 3)]; })};
}

}  // namespace

/// The thesis takes its loads per mm of face width for loads per mm of contact line where it evaluates contact: weights
/// are then the lengths on the face width, 12 mm each, while forces and everything structural stay as they are.
TEST_CASE("With finite elements of our own the thesis' sample outputs come out", "[reference][load][fe][.soak]") {
  const GearPair pair = make_gear_pair(reference::haddad_18_54::pair_data());
  auto wheel = std::async(std::launch::async, [&] { return influence_table(pair, Member::Wheel); });
  const auto pinion = influence_table(pair, Member::Pinion);
  const StructuralPair structure(pair, {pinion, kMaterial.youngs_modulus}, {wheel.get(), kMaterial.youngs_modulus});
  const MeshModel model = make_mesh_model(pair, {kMaterial, kMaterial}, {{QuadratureRule::Gauss2, 5}, {haddad::phase_a, haddad::phase_b}}, {}, {},
                                          {.structure = &structure});
  const double cos_base = std::cos(pair.base_helix_angle);

  for (const PrintedOutput& printed : outputs()) {
    const MeshPosition& at = model.positions[static_cast<std::size_t>(printed.position)];
    LoadProblem problem{at.influence, at.weight * cos_base, Eigen::VectorXd(at.weight.size()), at.laws, haddad::normal_force};
    Eigen::VectorXd load(at.weight.size());
    for (std::size_t i = 0; i < at.points.size(); ++i) {
      const ContactPoint& point = at.points[i];
      const auto row = std::find_if(printed.rows.begin(), printed.rows.end(), [&](const Row& r) {
        return r.tooth == point.tooth + haddad::reference_tooth && std::abs(r.z - 60 - point.z) < 1e-3;
      });
      REQUIRE(row != printed.rows.end());
      const auto k = static_cast<Eigen::Index>(i);
      problem.gap[k] = point.clearance - row->error * units::um;
      load[k] = row->load;
    }
    const LoadDistribution found = solve_load_distribution(problem);
    REQUIRE(found.usable());
    const auto peak_stress = [&](const Eigen::VectorXd& loads) {
      double peak = 0;
      for (std::size_t i = 0; i < at.points.size(); ++i) {
        peak = std::max(peak, hertz_line(loads[static_cast<Eigen::Index>(i)], at.points[i].relative_radius, model.contact_modulus).peak_pressure);
      }
      return peak;
    };
    const double f_t = found.transmission_error / units::um;
    const double rms = std::sqrt((found.line_load - load).squaredNorm() / static_cast<double>((load.array() > 0).count()));
    const double peak = found.line_load.maxCoeff() / load.maxCoeff();
    const double stress = peak_stress(found.line_load) / peak_stress(load);
    WARN(printed.name << ": f_t " << f_t << " (" << printed.transmission_error << "), peak load " << peak << ", peak stress " << stress
                      << " of the printed, rms " << rms << " N/mm");
    // Model: the thesis' curves are fits to a coarse mesh, not reciprocal, and its wheel of 54 teeth is interpolated
    // between 40 and 100 (2.6, 3.4).
    const bool pitch = printed.name[0] == '8';
    CHECK(std::abs(f_t - printed.transmission_error) < (pitch ? 0.08 : 0.03) * std::abs(printed.transmission_error));
    CHECK(peak == tests::about(1.0, 0.10));
    CHECK(stress == tests::about(1.0, 0.08));
    CHECK(rms < 8);
  }
}
