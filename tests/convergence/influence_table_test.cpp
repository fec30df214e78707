#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;

namespace {

constexpr double kFace = 4;

GearPair twins() { return pair_cases::pair(15, 15, 20, 1, kFace); }

GearToMesh gear_to_mesh() { return test::gear_of(15, 20, kFace); }

/// Coarse, but all teeth alike.
GearMeshOptions mesh_options() {
  GearMeshOptions options = test::coarse();
  options.adjacent_flank_elements = options.flank_elements;
  options.adjacent_fillet_elements = options.fillet_elements;
  options.teeth_each_side = 2;
  return options;
}

/// The finite elements' own values between the very points asked for, nothing interpolated.
class DirectInfluence final : public FlankCompliance {
 public:
  Eigen::MatrixXd evaluate(std::span<const FlankStation> places) const override {
    int lowest = places.front().tooth, highest = lowest;
    for (const FlankStation& p : places) {
      lowest = std::min(lowest, p.tooth);
      highest = std::max(highest, p.tooth);
    }
    const ToothForm& form = model_.mesh().form;
    std::vector<FlankPoint> points;
    for (const FlankStation& p : places) {
      points.push_back(
          {p.tooth - (lowest + highest) / 2, form.form_radius() + (p.u + 1) / 2 * (form.tip_radius() - form.form_radius()), p.zeta - kFace / 2});
    }
    return model_.influence(points).compliance;
  }

 private:
  InfluenceModel model_{gear_to_mesh(), {1, 0.3}, mesh_options()};
};

/// Transmission errors over one base pitch with that structure in both gears [mm].
Eigen::VectorXd transmission_errors(const std::shared_ptr<const FlankCompliance>& structure) {
  const GearPair pair = twins();
  constexpr double kModulus = 206000;
  const StructuralPair gears(pair, {structure, kModulus}, {structure, kModulus});
  const MeshModel model = make_mesh_model(pair, {{kModulus, 0.3}, {kModulus, 0.3}}, {{QuadratureRule::Gauss2, 5}, equally_spaced_phases(6)}, {}, {},
                                          {.structure = &gears});
  const LoadedCycle cycle = analyse_cycle(model, {}, 2000);
  REQUIRE(cycle.usable());
  Eigen::VectorXd errors(std::ssize(cycle.positions));
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    errors[i] = cycle.positions[static_cast<std::size_t>(i)].load.transmission_error;
  }
  return errors;
}

std::shared_ptr<const FlankCompliance> table(StationGrid grid) {
  const InfluenceTableTask task{.gear = gear_to_mesh(), .teeth_apart = 2, .mesh = mesh_options(), .grid = std::move(grid)};
  return std::make_shared<InfluenceTable>(*solve_influence_table(task, std::numeric_limits<double>::infinity()).table);
}

}  // namespace

TEST_CASE("The transmission error by an influence table comes to that by the finite elements' own values", "[convergence][fe]") {
  const Eigen::VectorXd direct = transmission_errors(std::make_shared<DirectInfluence>());
  const auto error_of = [&](StationGrid grid) {
    return ((transmission_errors(table(std::move(grid))) - direct).array() / direct.array()).abs().maxCoeff();
  };
  const double coarse = error_of({{-1, -0.4, 0.3, 1}, {0, 0.5, 2, 3.5, 4}});
  const double usual = error_of(station_grid(kFace));
  CAPTURE(coarse, usual, direct.transpose());
  CHECK(usual < 0.5 * coarse);
  CHECK(usual < 2e-3);  // discretisation: places, and teeth at the edge of what is meshed in detail
}
