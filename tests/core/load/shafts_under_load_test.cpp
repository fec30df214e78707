#include <catch2/catch.hpp>
#include <cmath>

#include "core/compliance/shaft/shaft_pair.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

constexpr double kFace = 60;

ShaftData shaft(double diameter, bool torque_at_first_end = true) {
  ShaftData data;
  data.sections = {{200, diameter}};
  data.bearings = {{.position = 0, .axial_stiffness = std::numeric_limits<double>::infinity()}, {.position = 200}};
  data.gear_position = 100;
  data.torque_position = torque_at_first_end ? 0 : 200;
  data.gear_stiffens = false;
  return data;
}

MeshModel model_with(const GearPair& gears, const PairCompliance* shafts, int positions = 4) {
  return make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, {{QuadratureRule::Gauss2, 8}, equally_spaced_phases(positions)}, {}, {},
                         {.shafts = shafts});
}

/// Where the load of a position has its centre [mm].
double centre_of_load(const MeshPosition& at, const LoadedPosition& loaded) {
  double force = 0.0, moment = 0.0;
  for (Eigen::Index i = 0; i < at.weight.size(); ++i) {
    const double f = at.weight[i] * loaded.load.line_load[i];
    force += f;
    moment += f * at.points[static_cast<std::size_t>(i)].z;
  }
  return moment / force;
}

}  // namespace

TEST_CASE("Very thick shafts change nothing", "[core][load][shaft]") {
  const GearPair gears = mesh_cases::pair(21, 40, 15, 4, kFace);
  const double torque = mesh_cases::torque_for(gears, 200);
  const ShaftPair thick(gears, shaft(1e5), shaft(1e5), GearBodyIn::Shaft);
  const LoadedCycle rigid = analyse_cycle(model_with(gears, nullptr), {}, torque);
  const LoadedCycle with = analyse_cycle(model_with(gears, &thick), {}, torque);
  REQUIRE(with.usable());
  // Model: shear of the thick shaft, 1e-9 of the teeth's compliance; the rest falls with the fourth power.
  CHECK((with.transmission_error() - rigid.transmission_error()).norm() < 1e-6 * rigid.transmission_error().norm());
}

TEST_CASE("The torque of a spur pinion is carried nearer to the end where it enters, alike from either end", "[core][load][shaft][physics]") {
  const GearPair gears = mesh_cases::pair(21, 40, 0, 4, kFace);
  const double torque = mesh_cases::torque_for(gears, 200);
  std::vector<double> centres;
  for (const bool first : {true, false}) {
    const ShaftPair shafts(gears, shaft(50, first), std::nullopt, GearBodyIn::Shaft);
    const MeshModel model = model_with(gears, &shafts, 1);
    const LoadedCycle cycle = analyse_cycle(model, {}, torque);
    REQUIRE(cycle.usable());
    centres.push_back(centre_of_load(model.positions[0], cycle.positions[0]));
  }
  CHECK(centres[0] < -0.02 * kFace);
  CHECK(centres[0] == Approx(-centres[1]).epsilon(1e-8));  // the solver's tolerance
}

TEST_CASE("Under load the shafts' twist is in the transmission error, to the micrometre of a torsion bar", "[core][load][shaft][closed-form]") {
  // Bearings right at the gear, torque in from far away: the bar's twist is the same for all points and adds to f_t.
  const GearPair gears = mesh_cases::pair(21, 40, 15, 4, kFace);
  ShaftData bar = shaft(50);
  bar.sections = {{300, 50}, {60, 50}};
  bar.bearings = {{.position = 300, .axial_stiffness = std::numeric_limits<double>::infinity()}, {.position = 360}};
  bar.gear_position = 330;
  ShaftData stub = bar;
  stub.torque_position = 300;
  const double torque = mesh_cases::torque_for(gears, 200);
  const ShaftPair with_bar(gears, bar, std::nullopt, GearBodyIn::Shaft), with_stub(gears, stub, std::nullopt, GearBodyIn::Shaft);
  const LoadedCycle a = analyse_cycle(model_with(gears, &with_bar), {}, torque);
  const LoadedCycle b = analyse_cycle(model_with(gears, &with_stub), {}, torque);
  const double G = bar.material.youngs_modulus / 2 / (1 + bar.material.poissons_ratio), J = units::pi * std::pow(50.0, 4) / 32;
  const double twist = torque / (G * J) * 300 * gears.pinion.base_radius * std::cos(gears.base_helix_angle);
  for (Eigen::Index i = 0; i < 4; ++i) {
    CHECK(a.transmission_error()[i] - b.transmission_error()[i] == Approx(twist).epsilon(1e-8));  // the solver's tolerance
    // The twist is no deformation of teeth.
    const LoadedPosition &twisted = a.positions[static_cast<std::size_t>(i)], &other = b.positions[static_cast<std::size_t>(i)];
    CHECK(twisted.approach_of_teeth() == Approx(other.approach_of_teeth()).epsilon(1e-8));
  }
}

TEST_CASE("What the shafts yield is told from the deformation of the teeth", "[core][load][shaft][physics]") {
  const GearPair gears = mesh_cases::pair(21, 40, 0, 4, kFace);
  const ShaftPair soft(gears, shaft(40), shaft(45, false), GearBodyIn::Shaft);
  const MeshModel model = model_with(gears, &soft);
  const LoadedCycle cycle = analyse_cycle(model, {}, mesh_cases::torque_for(gears, 200));
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const LoadedPosition& loaded = cycle.positions[i];
    const Eigen::VectorXd forces = model.positions[i].weight.cwiseProduct(loaded.load.line_load);
    // The mean of what the shafts yield under the loads, each point weighted by its load.
    const double by_shafts = forces.dot(soft.influence(model.positions[i].points, 0.0) * forces) / cycle.force;
    const double by_teeth = loaded.approach() - by_shafts;
    REQUIRE(by_shafts > 2.0 * by_teeth);
    constexpr double even_loads = 0.1;  // model: of even loads, where the shafts' twist moves them along the face
    CHECK(loaded.approach_of_teeth() == Approx(by_teeth).margin(even_loads * by_shafts));
  }
}

TEST_CASE("Derivatives with shafts are those of central differences", "[core][load][shaft][gradient]") {
  const GearPair gears = mesh_cases::pair(21, 40, 15, 4, kFace);
  const double torque = mesh_cases::torque_for(gears, 250);
  const ShaftPair shafts(gears, shaft(50), shaft(60, false), GearBodyIn::Shaft);
  const MeshModel model = model_with(gears, &shafts, 2);
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 4 * units::um;
  const std::vector<GearParameter> parameters{{Member::Pinion, parameter_of("lead_slope")}, {Member::Wheel, parameter_of("lead_crowning")}};
  const LoadedCycle cycle = analyse_cycle(model, condition, torque, {parameters.begin(), parameters.end()});
  const double step = 0.002 * units::um;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const LoadedCycle up = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], step), torque);
    const LoadedCycle down = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], -step), torque);
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::VectorXd difference = (up.positions[i].load.line_load - down.positions[i].load.line_load) / (2 * step);
      const Eigen::VectorXd found = cycle.positions[i].line_load_derivative.col(static_cast<Eigen::Index>(p));
      CHECK((found - difference).norm() < 1e-5 * found.norm());  // discretisation, and the solver's tolerance over the step
    }
  }
}
