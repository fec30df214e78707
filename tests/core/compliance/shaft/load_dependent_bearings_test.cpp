#include <catch2/catch.hpp>
#include <cmath>

#include "core/compliance/shaft/bearing_equilibrium.hpp"
#include "core/compliance/shaft/shaft_pair.hpp"
#include "core/compliance/shaft/unit_checks.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/compliance/shaft/pitch_point_lag.hpp"
#include "tests/core/gear/pair_cases.hpp"

using namespace flankwright;

namespace {

constexpr double by_load_round_off = 1e-9;  // of systems of three shafts and their equilibrium

GearPair helical_pair(WorkingFlank flank = WorkingFlank::Left) {
  PairData data = pair_cases::pair_data(23, 34, 10, 6.5, 74);
  data.pinion_hand = Hand::Left;
  data.working_flank = flank;
  return make_gear_pair(data);
}

BearingLawData balls() {
  return {.table_force = {}, .table_deflection = {}, .type = BearingType::DeepGrooveBall, .elements = 10, .element_diameter = 12.7};
}
BearingLawData rollers() {
  return {.table_force = {}, .table_deflection = {}, .type = BearingType::CylindricalRoller, .elements = 16, .element_length = 12};
}
BearingLawData table() { return {.table_force = {2000, 9000, 30000}, .table_deflection = {0.012, 0.03, 0.06}}; }

/// Input, intermediate and output shaft; the second stage is the pair. The intermediate shaft's bearings are these.
ShaftsOfPair unit_on(std::vector<ShaftBearing> bearings) {
  const auto shaft = [](double length, std::vector<ShaftBearing> on) {
    ShaftData made;
    made.sections = {{length, 80}};
    made.bearings = std::move(on);
    made.bearings.front().axial_stiffness = 1e6;
    return made;
  };
  ShaftsOfPair all;
  all.shaft.pinion = shaft(270, std::move(bearings));
  all.shaft.pinion->gear_position = 180;
  all.shaft.wheel = shaft(320, {{.position = 60, .radial_stiffness = 5e5}, {.position = 215, .radial_stiffness = 5e5}});
  all.shaft.wheel->gear_position = 140;
  all.shaft.wheel->torque_position = 310;
  all.unit.shafts = {shaft(220, {{.position = 65, .radial_stiffness = 5e5}, {.position = 205, .radial_stiffness = 5e5}})};
  all.unit.shafts[0].name = "input";
  all.unit.shafts[0].torque_position = 0;
  UnitMesh mesh;
  mesh.gears = {UnitGear{"input", 117, 27, 50}, UnitGear{"pinion", 72, 51, 50}};
  mesh.normal_module = 4.5;
  mesh.helix_angle = 21 * units::deg;
  mesh.centre_distance = 190;
  mesh.angle = -60 * units::deg;
  all.unit.meshes = {mesh};
  return all;
}

constexpr PerGear<GearBodyIn> teeth_on_shafts{GearBodyIn::Shaft, GearBodyIn::Shaft};

ShaftPair pair_on(std::vector<ShaftBearing> bearings, WorkingFlank flank = WorkingFlank::Left) {
  return ShaftPair(helical_pair(flank), unit_on(std::move(bearings)), teeth_on_shafts);
}

/// Where the pinion's shaft is in a bearing.
Eigen::Vector2d place_in(const UnitState& state, const BearingState& bearing) {
  const ShaftState& shaft = state.shafts.front();
  for (std::size_t i = 0; i < shaft.z.size(); ++i) {
    if (std::abs(shaft.z[i] - bearing.position) < 1e-9) return shaft.displacement[i].head<2>();
  }
  throw std::runtime_error("no station at the bearing");
}

/// Every shaft is in equilibrium, and where a bearing carries, its shaft is displaced against its force by the clearance and what the law has.
void check_equilibrium(const ShaftPair& shafts, const std::vector<ShaftBearing>& given, double torque) {
  const UnitState state = shafts.state(torque);
  CAPTURE(torque, state.iterations, state.clearance_residual);
  CHECK(state.converged);
  CHECK_FALSE(state.linear);
  for (const ShaftState& shaft : state.shafts) CHECK(shaft.residual < by_load_round_off);
  double largest = 0.0;
  for (const BearingState& bearing : state.bearings) largest = std::max(largest, bearing.force.head<2>().norm());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const BearingState& bearing = state.bearings[i];
    const Eigen::Vector2d force = bearing.force.head<2>(), place = place_in(state, bearing);
    const double clearance = 0.5 * given[i].radial_clearance;
    CAPTURE(bearing.name, force.norm(), place.norm());
    if (!bearing.carries) {
      CHECK(force.norm() == 0.0);
      CHECK(place.norm() <= clearance * (1 + 1e-9));
      continue;
    }
    double deflection = force.norm() / given[i].radial_stiffness;
    if (given[i].law.given()) {
      const RadialLaw law(given[i].law);
      deflection = law.deflection(force.norm());
      REQUIRE(bearing.law);
      CHECK(bearing.law->deflection == Approx(deflection).epsilon(by_load_round_off));
      CHECK(bearing.law->secant == Approx(force.norm() / deflection).epsilon(by_load_round_off));
      CHECK(bearing.law->tangent == Approx(1 / law.compliance(force.norm())).epsilon(by_load_round_off));
    }
    CHECK((place + (clearance + deflection) * force.normalized()).norm() < by_load_round_off * (clearance + deflection) + 1e-12);
  }
}

}  // namespace

TEST_CASE("A straight table is the constant stiffness", "[core][compliance][shaft][unit][bearing]") {
  const double k = 4e5;
  BearingLawData straight{.table_force = {k * 0.01, k * 0.025, k * 0.1}, .table_deflection = {0.01, 0.025, 0.1}};
  const ShaftPair constant = pair_on({{.position = 20, .radial_stiffness = k}, {.position = 250, .radial_stiffness = k}});
  const ShaftPair by_table = pair_on({{.position = 20, .law = straight}, {.position = 250, .law = straight}});
  CHECK(by_table.depends_on_load());
  CHECK_FALSE(constant.depends_on_load());
  const double torque = GENERATE(3e4, 1.1e6, 9e6);  // within the table and beyond it
  const UnitState one = constant.state(torque), two = by_table.state(torque);
  constexpr double straight_round_off = 1e-11;  // the pieces' slopes are differences of rounded numbers
  for (std::size_t i = 0; i < one.bearings.size(); ++i) {
    CHECK((one.bearings[i].force - two.bearings[i].force).norm() <= straight_round_off * one.bearings[i].force.norm());
  }
  CHECK(two.mesh_misalignment == Approx(one.mesh_misalignment).epsilon(straight_round_off));
  const ShaftPair tangent = by_table.at_torque(torque);
  const std::vector<ContactPoint> points =
      contact_points(helical_pair(), PathOfContact(helical_pair()), {QuadratureRule::Gauss2, 4}, 1.2, true, -37, 37);
  const Eigen::MatrixXd K = constant.influence(points, 0.0);
  CHECK((tangent.influence(points, 0.0) - K).cwiseAbs().maxCoeff() <= straight_round_off * K.cwiseAbs().maxCoeff());
  const OutsideMotion motion = tangent.outside_motion(points, 0.0);
  CHECK(motion.fixed.cwiseAbs().maxCoeff() < 1e-12);  // mm
}

TEST_CASE("Bearings of a shaft on two supports deflect as their law has it under forces that the law does not change",
          "[core][compliance][shaft][unit][bearing]") {
  const ShaftPair rigid = pair_on({{.position = 20}, {.position = 250}});
  const ShaftPair by_type = pair_on({{.position = 20, .law = balls()}, {.position = 250, .law = rollers()}});
  const UnitState without = rigid.state(1e6), one = by_type.state(1e6), two = by_type.state(2e6);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK((one.bearings[i].force - without.bearings[i].force).norm() < by_load_round_off * without.bearings[i].force.norm());
    CHECK((two.bearings[i].force - 2 * one.bearings[i].force).norm() < by_load_round_off * two.bearings[i].force.norm());
  }
  CHECK(two.bearings[0].law->deflection == Approx(std::pow(2.0, 2.0 / 3.0) * one.bearings[0].law->deflection).epsilon(by_load_round_off));
  CHECK(two.bearings[1].law->deflection == Approx(std::pow(2.0, 0.9) * one.bearings[1].law->deflection).epsilon(by_load_round_off));
  CHECK(one.bearings[0].law->tangent == Approx(1.5 * one.bearings[0].law->secant).epsilon(by_load_round_off));
  CHECK(one.bearings[1].law->tangent == Approx(one.bearings[1].law->secant / 0.9).epsilon(by_load_round_off));
}

TEST_CASE("Shafts on bearings whose stiffness depends on the load are in equilibrium on their laws", "[core][compliance][shaft][unit][bearing]") {
  const auto flank = GENERATE(WorkingFlank::Left, WorkingFlank::Right);
  const double torque = GENERATE(2e4, 1e6, 5e6);
  const std::vector<std::vector<ShaftBearing>> sets{
      // Statically indeterminate: laws share the load.
      {{.position = 10, .law = balls()}, {.position = 120, .law = table()}, {.position = 255, .law = rollers()}},
      // With clearances, of which the middle one may not be used up.
      {{.position = 10, .radial_clearance = 0.03, .law = balls()},
       {.position = 120, .radial_clearance = 0.09, .law = rollers()},
       {.position = 255, .radial_clearance = 0.02, .law = table()}},
      // Beside bearings with clearance that are rigid or have a constant stiffness, and one without either.
      {{.position = 10, .radial_clearance = 0.03},
       {.position = 90, .radial_stiffness = 3e5, .radial_clearance = 0.05},
       {.position = 150, .law = balls()},
       {.position = 255, .radial_clearance = 0.02, .law = rollers()}},
      {{.position = 10, .radial_stiffness = 6e5}, {.position = 120, .law = balls()}, {.position = 255, .radial_clearance = 0.04, .law = table()}},
  };
  for (const std::vector<ShaftBearing>& bearings : sets) check_equilibrium(pair_on(bearings, flank), bearings, torque);
}

TEST_CASE("A bearing between two shafts and a yielding housing go with a law", "[core][compliance][shaft][unit][bearing]") {
  ShaftsOfPair shafts = unit_on({{.position = 20, .name = "left", .law = balls()}, {.position = 250, .law = rollers()}});
  shafts.unit.housing.seats = {"left"};
  shafts.unit.housing.stiffness = 2e5 * Eigen::MatrixXd::Identity(3, 3);
  const UnitState state = ShaftPair(helical_pair(), shafts, teeth_on_shafts).state(1e6);
  const BearingState& left = state.bearings.front();
  const Eigen::Vector2d force = left.force.head<2>();
  const double moved = RadialLaw(balls()).deflection(force.norm()) + force.norm() / 2e5;
  CHECK((place_in(state, left) + moved * force.normalized()).norm() < by_load_round_off * moved);
  for (const ShaftState& shaft : state.shafts) CHECK(shaft.residual < by_load_round_off);
}

TEST_CASE("Shafts linearised on their laws are tangent to the true ones", "[core][compliance][shaft][unit][bearing]") {
  const ShaftPair unit = pair_on({{.position = 10, .radial_clearance = 0.02, .law = balls()},
                                  {.position = 115, .law = rollers()},
                                  {.position = 255, .radial_stiffness = 3e5, .radial_clearance = 0.02}});
  const GearPair pair = helical_pair();
  const auto lag = [&](const ShaftPair& at, double torque) { return lag_at_pitch_point(at, pair, torque); };
  const double T = 1e6;
  const ShaftPair tangent = unit.at_torque(T);
  CHECK(lag(tangent, T) == Approx(lag(unit.at_torque(T), T)).epsilon(by_load_round_off));
  double before = 0.0;
  for (const double step : {0.04, 0.02, 0.01}) {
    const double error = std::abs(lag(unit.at_torque(T * (1 + step)), T * (1 + step)) - lag(tangent, T * (1 + step)));
    // Half the step, a quarter of the error, as long as it is more than round-off.
    if (before > 1e-11) CHECK(error < 0.35 * before + 1e-12);
    before = error;
  }
}

TEST_CASE("The equilibrium on laws does not change with the order of bearings, and no load leaves no displacement",
          "[core][compliance][shaft][unit][bearing]") {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(4, 4);
  stiffness.diagonal() << 2e5, 2e5, 1e5, 1e5;
  stiffness(0, 2) = stiffness(2, 0) = -1e5;
  const Eigen::VectorXd forces = (Eigen::VectorXd(4) << 8000, 100, -500, 20).finished();
  const std::vector<NonlinearBearing> bearings{{0.02, std::nullopt}, {0.01, RadialLaw(balls())}};
  const ClearanceState one = solve_bearings(forces, stiffness, bearings);
  REQUIRE(one.converged);
  const std::vector<Eigen::Index> swapped{2, 3, 0, 1};
  const ClearanceState two = solve_bearings(forces(swapped), stiffness(swapped, swapped), {bearings[1], bearings[0]});
  REQUIRE(two.converged);
  CHECK((one.force - two.force(swapped)).norm() < by_load_round_off * one.force.norm());
  const ClearanceState none = solve_bearings(Eigen::VectorXd::Zero(4), stiffness, bearings);
  CHECK(none.converged);
  CHECK(none.shift.isZero());
  CHECK_FALSE(none.carries[0]);
}

TEST_CASE("A unit's bearing law that cannot be is refused by its key", "[core][compliance][shaft][unit][bearing]") {
  ShaftsOfPair all = unit_on({{.position = 20, .law = balls()}, {.position = 250}});
  CHECK(find_problems(all, helical_pair()).empty());
  all.shaft.pinion->bearings[0].law.elements = 2;
  const std::vector<InvalidInput> problems = find_problems(all, helical_pair());
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().field() == "pinion.shaft.bearings.0.elements");
  CHECK(problems.front().value() == "2");
}
