#include <catch2/catch.hpp>
#include <cmath>

#include "core/load/cycle/mesh_root_stress.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/core/load/synthetic_root_stress.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;

namespace {

MeshModel model_with_root_stress(const GearPair& gears, const MeshResolution& resolution, const MeshEffects& effects = {}) {
  const mesh_cases::SyntheticRootStress root_stress(gears);
  return make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, resolution, effects, {}, {.root_stress = &root_stress});
}

}  // namespace

TEST_CASE("Root stress is the principal stress of what all forces do together", "[core][load][root-stress]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = model_with_root_stress(gears, {{}, equally_spaced_phases(6)});
  const LoadedCycle cycle = analyse_cycle(model, {}, mesh_cases::torque_for(gears, 100));
  double pinion = 0, wheel = 0, tangent = 0;
  for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
    const MeshPosition& at = model.positions[k];
    const LoadedPosition& position = cycle.positions[k];
    REQUIRE(position.root_stress.size() == static_cast<Eigen::Index>(at.root_stress.stations.size()));
    for (std::size_t p = 0; p < at.root_stress.stations.size(); ++p) {
      const auto row = static_cast<Eigen::Index>(p);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      const Eigen::Matrix3Xd components = at.root_stress.components_of(row);
      for (Eigen::Index i = 0; i < at.weight.size(); ++i) sum += components.col(i) * at.weight[i] * position.load.line_load[i];
      Eigen::Matrix2d tensor;
      tensor << sum[0], sum[2], sum[2], sum[1];
      const double largest = symmetric_eigenvalues(tensor)[1];
      CHECK(position.root_stress[row] == Approx(largest).epsilon(1e-12));  // round-off
      const RootStation& station = at.root_stress.stations[p];
      double& peak = station.member == Member::Pinion ? pinion : wheel;
      peak = std::max(peak, position.root_stress[row]);
      if (station.tangent && station.member == Member::Pinion) tangent = std::max(tangent, position.root_stress[row]);
    }
  }
  const CycleSummary summary = summarise(model, cycle);
  CHECK(summary.pinion_root_stress.stress == pinion);
  CHECK(summary.wheel_root_stress.stress == wheel);
  CHECK(summary.peak_root_stress == std::max(pinion, wheel));
  CHECK(summary.pinion_root_stress.tangent_stress == tangent);
  CHECK(summary.pinion_root_stress.station.member == Member::Pinion);
  CHECK(summary.wheel_root_stress.station.member == Member::Wheel);
  CHECK(pinion > 0);
}

TEST_CASE("A mesh that gets its root stress later has that of one made with it", "[core][load][root-stress]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const mesh_cases::SyntheticRootStress root_stress(gears);
  const MeshResolution resolution{{QuadratureRule::Graded, 4}, equally_spaced_phases(3)};
  const bool with_root_stress = GENERATE(true, false);
  const MeshEffects effects = with_root_stress ? MeshEffects() : MeshEffects::all_but({"root_stress"});
  MeshPlacement placement;
  placement.misalignment.axial_offset = 4.0;
  const auto mesh = [&](const PairRootStress* model) {
    return make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, resolution, effects, placement, {.root_stress = model});
  };
  const MeshModel made_with = mesh(&root_stress);
  MeshModel added = mesh(nullptr);
  add_root_stress_influence(added, root_stress);
  for (std::size_t k = 0; k < added.positions.size(); ++k) {
    const RootStressInfluence &expected = made_with.positions[k].root_stress, &found = added.positions[k].root_stress;
    REQUIRE(expected.stations.empty() == !with_root_stress);
    REQUIRE(found.stations.size() == expected.stations.size());
    for (Eigen::Index i = 0; i < std::ssize(found.stations); ++i) CHECK(found.components_of(i) == expected.components_of(i));
  }
}

TEST_CASE("Root stress left for later is the same to the bit", "[core][load][root-stress]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = model_with_root_stress(gears, {{}, equally_spaced_phases(3)});
  const double torque = mesh_cases::torque_for(gears, 100);
  const LoadedCycle with_loads = analyse_cycle(model, {}, torque);
  LoadedCycle later = analyse_cycle(model, {}, torque, {}, RootStresses::Later);
  for (const LoadedPosition& position : later.positions) CHECK(position.root_stress.size() == 0);
  add_root_stress(model, later);
  for (std::size_t k = 0; k < later.positions.size(); ++k) CHECK(later.positions[k].root_stress == with_loads.positions[k].root_stress);
}

TEST_CASE("Twice the torque is twice the root stress where nothing else is nonlinear", "[core][load][root-stress]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshModel model =
      model_with_root_stress(gears, {{}, equally_spaced_phases(4)}, MeshEffects::all_but({"hertzian_contact", "extended_contact_region"}));
  const auto peak = [&](double load) { return summarise(model, analyse_cycle(model, {}, mesh_cases::torque_for(gears, load))).peak_root_stress; };
  CHECK(peak(200) == Approx(2 * peak(100)).epsilon(1e-11));  // round-off
}

TEST_CASE("Derivatives of root stress are what central differences say", "[core][load][root-stress][gradient]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = model_with_root_stress(gears, {{}, {0.1, 1.1, 1.7}});
  const std::vector<GearParameter> parameters{{Member::Pinion, parameter_of("lead_crowning")},
                                              {Member::Pinion, parameter_of("lead_slope")},
                                              {Member::Wheel, parameter_of("profile_crowning")}};
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 0.008;
  condition.modification.pinion.lead_slope = 0.003;
  set(condition.modification.wheel, parameter_of("profile_crowning"), 0.005);
  const double torque = mesh_cases::torque_for(gears, 300);
  const LoadedCycle at = analyse_cycle(model, condition, torque, {parameters.begin(), parameters.end()});
  constexpr double step = 1e-6;  // mm
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const LoadedCycle up = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], step), torque);
    const LoadedCycle down = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], -step), torque);
    for (std::size_t k = 0; k < at.positions.size(); ++k) {
      const Eigen::VectorXd difference = (up.positions[k].root_stress - down.positions[k].root_stress) / (2 * step);
      Eigen::VectorXd exact(difference.size());
      for (Eigen::Index station = 0; station < exact.size(); ++station) {
        exact[station] = root_stress_derivative(model.positions[k], at.positions[k], station)[static_cast<Eigen::Index>(p)];
      }
      // Discretisation: step^2 times curvature, and round-off over the step.
      CHECK((exact - difference).cwiseAbs().maxCoeff() < 1e-6 * difference.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("Without a model of it there is no root stress", "[core][load][root-stress]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = mesh_cases::model(gears, {{}, {1.0}});
  const LoadedCycle cycle = analyse_cycle(model, {}, mesh_cases::torque_for(gears, 100));
  CHECK(cycle.positions[0].root_stress.size() == 0);
  const CycleSummary summary = summarise(model, cycle);
  CHECK(std::isnan(summary.peak_root_stress));
  CHECK(std::isnan(summary.pinion_root_stress.stress));
  CHECK(std::isnan(summary.wheel_root_stress.tangent_stress));
}
