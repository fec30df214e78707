#include "core/compliance/shaft/shaft_pair.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/compliance/shaft/bearing_clearance.hpp"
#include "core/compliance/shaft/unit_checks.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/compliance/shaft/pitch_point_lag.hpp"
#include "tests/core/compliance/shaft/unit_cases.hpp"
#include "tests/core/gear/pair_cases.hpp"

using namespace flankwright;
using namespace unit_cases;

namespace {

const BearingState& bearing_of(const UnitState& state, const std::string& name) {
  return *std::ranges::find(state.bearings, name, &BearingState::name);
}

std::string first_problem(const ShaftsOfPair& all) {
  const std::vector<InvalidInput> problems = find_problems(all, second_stage());
  return problems.empty() ? "" : problems.front().field() + " = " + problems.front().value() + ": " + problems.front().allowed();
}

}  // namespace

TEST_CASE("Two shafts in a unit that couples nothing are today's two shafts", "[core][compliance][shaft][unit]") {
  const GearPair pair = second_stage(WorkingFlank::Right);
  ShaftsOfPair apart = two_stages();
  apart.shaft.pinion->torque_position = 0;
  apart.unit = {};
  // A unit beside them: a shaft of its own, which nothing joins to the pair.
  ShaftsOfPair beside = apart;
  beside.unit.shafts = {shaft_of_unit(150, {10, 140})};
  beside.unit.shafts[0].name = "beside";
  beside.unit.shafts[0].torque_position = 0;
  const std::vector<ContactPoint> points = unit_points(pair);
  const ShaftPair only_pinion(pair, apart.shaft.pinion, std::nullopt, on_shafts), only_wheel(pair, std::nullopt, apart.shaft.wheel, on_shafts);
  const Eigen::MatrixXd sum = only_pinion.influence(points, 0.0) + only_wheel.influence(points, 0.0);
  for (const ShaftsOfPair& shafts : {apart, beside}) {
    const ShaftPair together(pair, shafts, on_shafts);
    CHECK((together.influence(points, 0.0) - sum).cwiseAbs().maxCoeff() <= 1e-12 * sum.cwiseAbs().maxCoeff());
    const OutsideMotion motion = together.outside_motion(points, 0.0);
    CHECK((motion.by_force.size() == 0 || motion.by_force.cwiseAbs().maxCoeff() == 0.0));
  }
}

TEST_CASE("The intermediate shaft's bearings carry what a hand calculation of both meshes has", "[core][compliance][shaft][unit][closed-form]") {
  const ShaftsOfPair shafts = two_stages();
  const double torque = 1.1e6;
  const ShaftPair unit(second_stage(), shafts, on_shafts);
  const UnitState state = unit.state(torque);
  // First stage. The input's torque is 27/51 of the intermediate one; it turns +z, and the intermediate shaft -z, whose pinion so works on its left flank.
  const double tan_n = std::tan(20 * units::deg);
  CHECK(state.meshes[1].torque[0] == Approx(torque * 27 / 51).epsilon(in_unit));
  CHECK(state.meshes[1].torque[1] == Approx(torque).epsilon(in_unit));
  CHECK(state.meshes[0].torque[0] == Approx(-torque).epsilon(in_unit));
  CHECK(state.meshes[1].first_flank == WorkingFlank::Right);
  CHECK(state.meshes[0].first_flank == WorkingFlank::Left);
  CHECK(state.shafts[2].coupling_torque == Approx(torque * 27 / 51).epsilon(in_unit));
  CHECK(state.shafts[1].coupling_torque == Approx(-torque * 34 / 23).epsilon(in_unit));
  // Forces on the intermediate shaft: on the wheel of the first stage, which its pinion pushes along +t = z x e, and away from it along e. A
  // right-hand driver that turns +z pushes its mate along -z.
  const double angle = -60 * units::deg;
  const Eigen::Vector3d e(std::cos(angle), std::sin(angle), 0), t(-std::sin(angle), std::cos(angle), 0), z = Eigen::Vector3d::UnitZ();
  const double r1 = 4.5 * 51 / 2 / std::cos(21 * units::deg), a1 = 4.5 * 78 / 2 / std::cos(21 * units::deg);
  const double alpha_t1 = std::atan(tan_n / std::cos(21 * units::deg)), alpha_w1 = std::acos(a1 / 190 * std::cos(alpha_t1));
  const double rw1 = 190.0 * 51 / 78, Ft1 = torque / rw1;
  const double tan_w1 = std::tan(21 * units::deg) * rw1 / r1;
  const Eigen::Vector3d F1 = Ft1 * (t + std::tan(alpha_w1) * e - tan_w1 * z), arm1 = -rw1 * e;
  // Second stage: the pinion drives the wheel along -y; the reaction is +y and away from the wheel, -x. A left-hand driver that turns -z pushes its mate
  // along -z and is pushed along +z: against the first stage's wheel.
  const double alpha_t2 = std::atan(tan_n / std::cos(10 * units::deg)), r2 = 6.5 * 23 / 2 / std::cos(10 * units::deg);
  const double Ft2 = torque / r2;
  const Eigen::Vector3d F2 = Ft2 * Eigen::Vector3d(-std::tan(alpha_t2), 1.0, std::tan(10 * units::deg)), arm2(r2, 0, 0);
  // Bearings at 20 and 250; the left one takes the thrust.
  const auto about_left = [&](double at) { return at - 20; };
  const Eigen::Vector3d moment =
      arm1.cross(F1) + Eigen::Vector3d(0, 0, about_left(72)).cross(F1) + arm2.cross(F2) + Eigen::Vector3d(0, 0, about_left(180)).cross(F2);
  CHECK(std::abs(moment.z()) < 1e-9 * torque);  // the shaft's torques balance
  const Eigen::Vector3d right(-moment.y() / 230, moment.x() / 230, 0), left = -F1 - F2 - right;
  const BearingState &first = bearing_of(state, "pinion 1"), &second = bearing_of(state, "pinion 2");
  constexpr double force_scale = 1e-8;  // of some 10 kN
  CHECK((first.force - left).norm() < force_scale * left.norm());
  CHECK((second.force - right).norm() < force_scale * right.norm());
  CHECK(std::abs(F1.z() + F2.z()) < std::abs(F1.z()));  // thrusts against each other
  for (const ShaftState& shaft : state.shafts) CHECK(shaft.residual < in_unit);
}

TEST_CASE("Other meshes' motion is what the shaft does under their forces, in proportion to the torque", "[core][compliance][shaft][unit]") {
  const GearPair pair = second_stage();
  const ShaftPair unit(pair, two_stages(), on_shafts);
  const std::vector<ContactPoint> points = unit_points(pair);
  const OutsideMotion motion = unit.outside_motion(points, 0.0);
  REQUIRE(motion.by_force.size() == std::ssize(points));
  CHECK(motion.fixed.size() == 0);
  CHECK(motion.by_force.cwiseAbs().maxCoeff() > 0.0);
  const UnitState one = unit.state(4e5), two = unit.state(8e5);
  CHECK(two.mesh_misalignment == Approx(2 * one.mesh_misalignment).epsilon(in_unit));
  CHECK(two.outside_misalignment == Approx(2 * one.outside_misalignment).epsilon(in_unit));
  for (std::size_t i = 0; i < one.bearings.size(); ++i) {
    CHECK((two.bearings[i].force - 2 * one.bearings[i].force).norm() <= in_unit * two.bearings[i].force.norm());
  }
  // What other forces open over the face is what the state says of them: rigid teeth that follow two straight lines.
  const auto n = std::ssize(points);
  const double F = 4e5 / (pair.pinion.base_radius * std::cos(pair.base_helix_angle));
  Eigen::MatrixXd line(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) line.row(i) << 1.0, points[static_cast<std::size_t>(i)].z, points[static_cast<std::size_t>(i)].phase;
  const double slope = line.colPivHouseholderQr().solve(F * motion.by_force)[1] * 74 / std::cos(pair.base_helix_angle);
  CHECK(slope == Approx(one.outside_misalignment).epsilon(0.1));  // model: shafts bend over the face, and twist
}

TEST_CASE("A unit in a mirror does the same in the mirror", "[core][compliance][shaft][unit]") {
  ShaftsOfPair shafts = two_stages();
  shafts.unit.loads = {{"input", 5, {300, 200, -100}, {1e4, 2e4, 0}}};
  shafts.unit.reference_torque = 1e6;
  ShaftsOfPair mirror = shafts;
  mirror = mirrored(shafts);
  const UnitState one = ShaftPair(second_stage(WorkingFlank::Left, Hand::Left), shafts, on_shafts).state(1e6);
  const UnitState two = ShaftPair(second_stage(WorkingFlank::Right, Hand::Right), mirror, on_shafts).state(1e6);
  CHECK(one.mesh_misalignment == Approx(two.mesh_misalignment).epsilon(in_unit));
  for (std::size_t i = 0; i < one.bearings.size(); ++i) {
    Eigen::Vector3d turned = two.bearings[i].force;
    turned.y() *= -1.0;
    CHECK((one.bearings[i].force - turned).norm() <= in_unit * turned.norm());
  }
}

TEST_CASE("A bearing's clearance lets the shaft to its border, along its force", "[core][compliance][shaft][unit][closed-form]") {
  ShaftsOfPair shafts = two_stages();
  const GearPair pair = second_stage();
  const ShaftPair closed(pair, shafts, on_shafts);
  shafts.shaft.pinion->bearings[0].radial_clearance = 0.04;
  shafts.shaft.pinion->bearings[1].radial_clearance = 0.06;
  const ShaftPair open(pair, shafts, on_shafts);
  CHECK(open.depends_on_load());
  CHECK_FALSE(closed.depends_on_load());
  const UnitState with = open.state(1e6), without = closed.state(1e6);
  CHECK_FALSE(with.linear);
  CHECK(with.converged);
  for (const char* name : {"pinion 1", "pinion 2"}) {
    const BearingState &here = bearing_of(with, name), &there = bearing_of(without, name);
    // Statically determinate: forces stay, the shaft is shifted by half the clearance against the bearing.
    CHECK((here.force - there.force).norm() < in_unit * there.force.norm());
    const Eigen::Vector2d outwards = -there.force.head<2>().normalized() * 0.5 * here.radial_clearance;
    CHECK((here.shift - outwards).norm() < in_unit);
  }
  // At the equilibrium the linearised shafts stand where the shafted ones do: moved with the shifts as a rigid body.
  const ShaftState &moved = with.shafts[0], &held = without.shafts[0];
  for (std::size_t i = 0; i < moved.z.size(); ++i) {
    const double part = (moved.z[i] - 20) / 230;
    const Eigen::Vector2d shift = (1 - part) * bearing_of(with, "pinion 1").shift + part * bearing_of(with, "pinion 2").shift;
    CHECK((moved.displacement[i].head<2>() - held.displacement[i].head<2>() - shift).norm() < 1e-9);
  }
}

TEST_CASE("Linearised shafts are tangent to those with clearance", "[core][compliance][shaft][unit]") {
  // Three bearings, of which the middle one touches or not: at twice the torque the state has changed by the tangent's prediction, to second order.
  ShaftsOfPair shafts = two_stages(3e5);
  shafts.shaft.pinion->bearings = {{.position = 10, .radial_stiffness = 3e5, .axial_stiffness = 1e6, .radial_clearance = 0.02},
                                   {.position = 115, .radial_stiffness = 3e5, .radial_clearance = 0.03},
                                   {.position = 255, .radial_stiffness = 3e5, .radial_clearance = 0.02}};
  const GearPair pair = second_stage();
  const ShaftPair unit(pair, shafts, on_shafts);
  const auto lag = [&](const ShaftPair& at, double torque) { return lag_at_pitch_point(at, pair, torque); };
  const double T = 1e6;
  const ShaftPair tangent = unit.at_torque(T);
  double before = 0.0;
  for (const double step : {0.02, 0.01, 0.005}) {
    const double truth = lag(unit.at_torque(T * (1 + step)), T * (1 + step)), predicted = lag(tangent, T * (1 + step));
    const double error = std::abs(truth - predicted);
    // Half the step, a quarter of the error, as long as it is more than round-off.
    if (before > 1e-11) CHECK(error < 0.35 * before + 1e-12);
    before = error;
  }
  CHECK(lag(tangent, T) == Approx(lag(unit.at_torque(T), T)).epsilon(1e-9));
}

TEST_CASE("Shafts find their place within clearances, whatever carries", "[core][compliance][shaft][unit]") {
  // Two bearings coupled by N; the second is unloaded by what the first one's shift does, and lets go.
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(4, 4);
  stiffness.diagonal() << 2e5, 2e5, 1e5, 1e5;
  stiffness(0, 2) = stiffness(2, 0) = -1e5;
  const Eigen::VectorXd forces = (Eigen::VectorXd(4) << 8000, 100, -500, 20).finished(), clearance = Eigen::VectorXd::Constant(2, 0.02);
  const ClearanceState state = solve_clearances(forces, stiffness, clearance);
  REQUIRE(state.converged);
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::Vector2d shift = state.shift.segment<2>(2 * i), force = state.force.segment<2>(2 * i);
    CHECK(shift.norm() <= clearance[i] * (1 + 1e-12));
    if (state.carries[static_cast<std::size_t>(i)]) {
      CHECK(shift.norm() == Approx(clearance[i]).epsilon(1e-10));
      CHECK(std::abs(shift.x() * force.y() - shift.y() * force.x()) < 1e-6 * force.norm() * clearance[i]);  // pressed along the shift
      CHECK(shift.dot(force) > 0.0);
    } else {
      CHECK((forces - stiffness * state.shift).segment<2>(2 * i).norm() < 1e-4);  // N: it carries nothing
    }
  }
}

TEST_CASE("Units that cannot be are refused by their key", "[core][compliance][shaft][unit]") {
  using Catch::Contains;
  CHECK(first_problem(two_stages()).empty());
  ShaftsOfPair all = two_stages();
  all.unit.meshes[0].gears[0].shaft = "inptu";
  CHECK_THAT(first_problem(all), Contains("unit.meshes.0.shaft_1 = inptu: one of pinion, wheel, input"));
  all = two_stages();
  all.unit.meshes[0].gears[0].position = 215;
  CHECK_THAT(first_problem(all), Contains("unit.meshes.0.position_1 = 215: on the shaft \"input\""));
  all = two_stages();
  all.unit.shafts[0].bearings.pop_back();
  CHECK_THAT(first_problem(all), Contains("unit.shafts.0.bearings") && Contains("held against tilting"));
  all = two_stages();
  all.unit.shafts[0].bearings[0].axial_stiffness = 0;
  CHECK_THAT(first_problem(all), Contains("unit.shafts.0.bearings") && Contains("axial_stiffness"));
  all = two_stages();
  all.unit.shafts[0].bearings[1].position = 65;
  CHECK_THAT(first_problem(all), Contains("unit.shafts.0.bearings.1.position") && Contains("a position of its own"));
  all = two_stages();
  all.unit.shafts[0].torque_position = not_given;
  CHECK_THAT(first_problem(all), Contains("unit.shafts.0 = ") && Contains("left over"));
  all = two_stages();
  all.shaft.pinion->torque_position = 5;
  CHECK_THAT(first_problem(all), Contains("unit.meshes = torques that the balance leaves open"));
  all.unit.meshes[0].torque = 1e5;
  all.unit.reference_torque = 1e6;
  CHECK(first_problem(all).empty());
  all = two_stages();
  all.unit.joints = {{"wheel", "input", 10, {.position = 200}}};
  CHECK_THAT(first_problem(all), Contains("unit.joints.0.outer_shaft") && Contains("apart"));
  all = two_stages();
  all.unit.meshes[0].gears[0].shaft = "pinion";  // where the pair's pinion sits, with its teeth, but not with its helix
  all.unit.meshes[0].gears[1].shaft = "input";
  all.unit.meshes[0].gears[0] = {"pinion", 180, 23, 50};
  all.unit.meshes[0].normal_module = 6.5;
  all.unit.meshes[0].centre_distance = not_given;
  CHECK_THAT(first_problem(all), Contains("unit.meshes.0.helix_angle = 21: that of pinion") && Contains("10 deg"));
  all.unit.meshes[0].helix_angle = 10 * units::deg;
  CHECK_THAT(first_problem(all), Contains("unit.meshes.0.hand_1 = right: \"left\""));
  all = two_stages();
  all.unit.housing = {{"pinion 1"}, Eigen::MatrixXd::Identity(2, 2)};
  CHECK_THAT(first_problem(all), Contains("unit.housing.stiffness = 4 numbers: 9 numbers"));
  all.unit.housing.stiffness = -Eigen::MatrixXd::Identity(3, 3);
  CHECK_THAT(first_problem(all), Contains("positive definite"));
}

TEST_CASE("Gears in a loop turn at one speed, and meet along their shafts", "[core][compliance][shaft][unit]") {
  using Catch::Contains;
  // The first stage a second time on the same two shafts, as a split of its power.
  ShaftsOfPair all = two_stages();
  all.unit.shafts[0].sections = {{300, 50}};
  all.unit.meshes.push_back(all.unit.meshes[0]);
  UnitMesh& second = all.unit.meshes[1];
  CHECK_THAT(first_problem(all), Contains("unit.meshes.1.name = first stage: a name of its own: unit.meshes.0.name has this one"));
  second.name = "second path";
  second.gears[0].position = 40;
  second.gears[1].position = -5 + 1;  // 77 mm from the first one on the input shaft, 76 mm on the other: faces of 50 mm meet all the same
  second.torque = -1e5;
  all.unit.reference_torque = 1e6;
  all.shaft.pinion->sections = {{400, 80}};
  for (ShaftBearing& bearing : all.shaft.pinion->bearings) bearing.position += 100;
  all.shaft.pinion->gear_position += 100;
  for (UnitMesh& mesh : all.unit.meshes) mesh.gears[1].position += 100;
  CHECK(first_problem(all).empty());
  ShaftsOfPair locked = all;
  locked.unit.meshes[1].gears[0].teeth = 28;
  locked.unit.meshes[1].gears[1].teeth = 50;
  locked.unit.meshes[1].centre_distance = 190;
  CHECK_THAT(first_problem(locked), Contains("unit.meshes.1.teeth_2 = 50") && Contains("can turn"));
  ShaftsOfPair apart = all;
  apart.unit.meshes[1].gears[1].position = 40;
  CHECK_THAT(first_problem(apart), Contains("unit.meshes.1.position_2 = 40") && Contains("faces meet"));
}

TEST_CASE("A gear that idles carries nothing, drives nothing and holds no shaft against turning", "[core][compliance][shaft][unit]") {
  const GearPair pair = second_stage();
  for (int teeth = 15; teeth <= 40; ++teeth) {
    ShaftsOfPair all = two_stages();
    all.unit.shafts.push_back(shaft_of_unit(220, {65, 205}));
    all.unit.shafts[1].name = "idle";
    UnitMesh idle;
    idle.gears = {UnitGear{"idle", 110, teeth, 40}, UnitGear{"pinion", 72, 51, 50}};
    idle.normal_module = 4.5;
    idle.helix_angle = 21 * units::deg;
    idle.hand = Hand::Right;
    idle.angle = 120 * units::deg;
    idle.stiffness = 2e4;
    for (const bool is_first : {false, true}) {  // whichever is listed first
      CAPTURE(teeth, is_first);
      ShaftsOfPair shafts = all;
      shafts.unit.meshes.insert(is_first ? shafts.unit.meshes.begin() : shafts.unit.meshes.end(), idle);
      REQUIRE(first_problem(shafts).empty());
      const std::size_t at = is_first ? 0 : 1;
      CHECK(torques_as_analysed(shafts, pair).mesh[at] == 0.0);
      CHECK(meshes_per_revolution(shafts, pair, Member::Pinion) == 1);
      settle_turning_holds(shafts, pair);
      CHECK(shafts.shaft.pinion->held_position == 72.0);
    }
  }
}

TEST_CASE("A shaft is held against turning where its torque leaves, whichever mesh is listed first", "[core][compliance][shaft][unit]") {
  // A third gear on the intermediate shaft takes nothing: its own shaft has no coupling. The first stage's gear stands on one side of the pinion, this one on the other.
  const GearPair pair = second_stage();
  ShaftsOfPair all = two_stages();
  all.shaft.pinion->sections = {{350, 80}};
  all.unit.shafts.push_back(shaft_of_unit(220, {65, 205}));
  all.unit.shafts[1].name = "idle";
  UnitMesh idle;
  idle.gears = {UnitGear{"idle", 110, 20, 20}, UnitGear{"pinion", 300, 40, 20}};
  idle.normal_module = 4.5;
  idle.angle = 120 * units::deg;
  all.unit.meshes.insert(all.unit.meshes.begin(), idle);
  REQUIRE(first_problem(all).empty());
  settle_turning_holds(all, pair);
  CHECK(all.shaft.pinion->held_position == 72.0);
  CHECK(all.shaft.pinion->torque_side() == -1);
  // So it is where a coupling that carries nothing stands at the other end.
  all.shaft.pinion->torque_position = 340;
  all.unit.meshes[1].torque = -torques_as_analysed(two_stages(), pair).mesh[0] * 1e6;  // mirrored: the pair works on its left flank
  all.unit.reference_torque = 1e6;
  REQUIRE(first_problem(all).empty());
  settle_turning_holds(all, pair);
  CHECK(all.shaft.pinion->held_position == 72.0);
}

TEST_CASE("Gears of two shafts in one place are refused by the angle of their mesh", "[core][compliance][shaft][unit]") {
  ShaftsOfPair all = two_stages();
  // A second pinion on the wheel, opposite to the first one.
  all.unit.shafts.push_back(shaft_of_unit(220, {65, 205}));
  all.unit.shafts[1].name = "twin";
  all.unit.shafts[1].torque_position = 0;
  UnitMesh mesh;
  mesh.gears = {UnitGear{"twin", 110, 23, 74}, UnitGear{"wheel", 140, 34, 74}};
  mesh.normal_module = 6.5;
  mesh.helix_angle = 10 * units::deg;
  mesh.hand = Hand::Left;
  mesh.centre_distance = second_stage().centre_distance;
  mesh.torque = -1e5;
  all.unit.reference_torque = 1e6;
  all.unit.meshes.push_back(mesh);
  const auto problem_at = [&](double degrees) {
    all.unit.meshes[1].angle = degrees * units::deg;
    return first_problem(all);
  };
  CHECK(problem_at(180.0).empty());
  // Roots of 23 teeth take 2 (75.9 - 8.1) mm: at a centre distance of 190 mm the pinions clear each other from about 42 deg on.
  CHECK(problem_at(60.0).empty());
  CHECK_THAT(problem_at(0.0), Catch::Contains("unit.meshes.1.angle") && Catch::Contains("leaves room"));
  CHECK_THAT(problem_at(20.0), Catch::Contains("leaves room"));
}
