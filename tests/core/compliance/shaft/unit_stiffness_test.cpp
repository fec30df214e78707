#include <catch2/catch.hpp>
#include <cmath>

#include "core/compliance/shaft/unit_checks.hpp"
#include "tests/core/compliance/shaft/unit_cases.hpp"

/// What holds shafts beyond single springs, and what loads them beyond forces in proportion to the torque.
using namespace flankwright;
using namespace unit_cases;

namespace {

constexpr double unit_torque = 1.1e6;  // [N mm]

double largest(const Eigen::MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

/// The unit with meshes that tilt freely, or against teeth.
UnitState with_mesh_stiffness(double stiffness) {
  ShaftsOfPair shafts = two_stages();
  shafts.unit.meshes[0].stiffness = stiffness;
  return ShaftPair(second_stage(), shafts, on_shafts).state(unit_torque);
}

std::string refused_unit(const ShaftsOfPair& shafts) {
  const std::vector<InvalidInput> problems = find_problems(shafts, second_stage());
  return problems.empty() ? "" : problems.front().field();
}

Eigen::Vector3d in_mirror(const Eigen::Vector3d& force) { return {force.x(), -force.y(), force.z()}; }

}  // namespace

TEST_CASE("A bearing's matrix without coupling is its stiffnesses one by one", "[core][compliance][shaft][unit]") {
  ShaftsOfPair singly = two_stages(), together = singly;
  const double radial = 4e5, axial = 2e5, tilting = 3e8;
  ShaftBearing& one = singly.shaft.pinion->bearings[0];
  one.radial_stiffness = radial;
  one.axial_stiffness = axial;
  one.tilting_stiffness = tilting;
  ShaftBearing& all = together.shaft.pinion->bearings[0];
  all.radial_stiffness = std::numeric_limits<double>::infinity();
  all.axial_stiffness = 0.0;
  all.stiffness_matrix = Eigen::Matrix<double, 5, 1>(radial, radial, axial, tilting, tilting).asDiagonal();
  const GearPair pair = second_stage();
  const std::vector<ContactPoint> points = unit_points(pair);
  const ShaftPair by_numbers(pair, singly, on_shafts), by_matrix(pair, together, on_shafts);
  const Eigen::MatrixXd expected = by_numbers.influence(points, 0.0);
  CHECK(largest(by_matrix.influence(points, 0.0) - expected) <= in_unit * largest(expected));
  const UnitState state = by_matrix.state(unit_torque);
  for (std::size_t i = 0; i < state.bearings.size(); ++i) {
    const BearingState& other = by_numbers.state(unit_torque).bearings[i];
    CHECK((state.bearings[i].force - other.force).norm() <= 1e-8 * other.force.norm());  // round-off of supports without compliance of their own
  }
}

TEST_CASE("A shaft in one bearing moves as the bearing's matrix says", "[core][compliance][shaft][unit][closed-form]") {
  // Tapered rollers: a force along x tilts, a moment shifts. A determinate shaft adds w'K^-1 w, with w the load seen from the bearing.
  Eigen::MatrixXd stiffness = Eigen::Matrix<double, 5, 1>(6e5, 5e5, 2e5, 4e8, 5e8).asDiagonal();
  stiffness(0, 4) = stiffness(4, 0) = 6e6;
  stiffness(1, 3) = stiffness(3, 1) = -5e6;
  stiffness(0, 2) = stiffness(2, 0) = 3e4;
  const GearPair pair = second_stage(WorkingFlank::Right);
  const auto with_bearing = [&](const ShaftBearing& bearing) {
    ShaftData shaft = shaft_of_unit(270, {20});
    shaft.gear_position = 180;
    shaft.torque_position = 0;
    shaft.bearings = {bearing};
    return ShaftPair(pair, shaft, std::nullopt, on_shafts);
  };
  constexpr double rigid = std::numeric_limits<double>::infinity();
  const ShaftPair clamped = with_bearing({.position = 20, .axial_stiffness = rigid, .tilting_stiffness = rigid});
  const ShaftPair yielding = with_bearing({.position = 20, .stiffness_matrix = stiffness});
  ContactPoint pitch_point;
  pitch_point.z = 10;
  const PathOfContact path(pair);
  pitch_point.phase = (pair.pitch_point - path.roll_at_start) / path.base_pitch;
  const double alpha = pair.working_transverse_pressure_angle, beta = pair.base_helix_angle;
  const Eigen::Vector3d force(-std::cos(beta) * std::sin(alpha), -std::cos(beta) * std::cos(alpha), pair.contact_line_sense() * std::sin(beta));
  const Eigen::Vector3d moment = Eigen::Vector3d(pair.pinion.working_pitch_radius, 0, 180 + pitch_point.z - 20).cross(force);
  Eigen::VectorXd seen(5);
  seen << force, moment.head<2>();
  const double added = yielding.influence({pitch_point}, 0.0)(0, 0) - clamped.influence({pitch_point}, 0.0)(0, 0);
  CHECK(added == Approx(seen.dot(stiffness.ldlt().solve(seen))).epsilon(1e-7));  // round-off of a difference
}

TEST_CASE("Constant loads do what the same loads do in proportion, at the torque that they are meant at", "[core][compliance][shaft][unit]") {
  ShaftsOfPair in_proportion = two_stages(), constant = in_proportion;
  UnitLoad load{"pinion", 130, {2000, -900, 300}, {2e4, -1e4, 0}};
  in_proportion.unit.loads = {load};
  in_proportion.unit.reference_torque = unit_torque;
  load.constant = true;
  constant.unit.loads = {load};
  const GearPair pair = second_stage();
  const std::vector<ContactPoint> points = unit_points(pair);
  const ShaftPair scaled(pair, in_proportion, on_shafts), fixed(pair, constant, on_shafts), unloaded(pair, two_stages(), on_shafts);
  const double force = unit_torque / (pair.pinion.base_radius * std::cos(pair.base_helix_angle));
  const auto gap = [&](const ShaftPair& shafts, double share) {
    Eigen::VectorXd opened = Eigen::VectorXd::Zero(std::ssize(points));
    shafts.outside_motion(points, 0.0).add_to(opened, share * force);
    return opened;
  };
  CHECK(largest(gap(scaled, 1.0) - gap(fixed, 1.0)) <= in_unit * largest(gap(scaled, 1.0)));
  // Half the torque: half of the rest, and all of what does not change.
  const Eigen::VectorXd of_load = gap(fixed, 0.0);
  CHECK(largest(gap(fixed, 0.5) - 0.5 * gap(unloaded, 1.0) - of_load) <= in_unit * largest(gap(unloaded, 1.0)));
  CHECK(largest(of_load) > 1e-4);
  const UnitState one = scaled.state(unit_torque), two = fixed.state(unit_torque), half = fixed.state(0.5 * unit_torque);
  CHECK(two.outside_misalignment == Approx(one.outside_misalignment).epsilon(in_unit));
  for (std::size_t i = 0; i < one.bearings.size(); ++i)
    CHECK((one.bearings[i].force - two.bearings[i].force).norm() <= 1e-8 * one.bearings[i].force.norm());
  for (const ShaftState& shaft : half.shafts) CHECK(shaft.residual < in_unit);
  // A bearing with clearance finds its place under them as well.
  constant.shaft.pinion->bearings[1].radial_clearance = in_proportion.shaft.pinion->bearings[1].radial_clearance = 0.03;
  const UnitState loose_one = ShaftPair(pair, in_proportion, on_shafts).state(unit_torque),
                  loose_two = ShaftPair(pair, constant, on_shafts).state(unit_torque);
  CHECK(loose_one.mesh_misalignment == Approx(loose_two.mesh_misalignment).epsilon(1e-7));  // residual of the equilibrium
}

TEST_CASE("Teeth of another mesh hold its shafts against tilting as one spring does", "[core][compliance][shaft][unit][closed-form]") {
  // Shafts that tilt freely by theta_0 against each other, and yield by a per moment, tilt by theta_0/(1 + a k) against a spring k.
  const double free = with_mesh_stiffness(not_given).meshes[1].misalignment;
  const double soft = with_mesh_stiffness(5e3).meshes[1].misalignment, usual = with_mesh_stiffness(2e4).meshes[1].misalignment;
  REQUIRE(std::abs(free) > 1e-3);
  CHECK((1 / usual - 1 / free) / (1 / soft - 1 / free) == Approx(4.0).epsilon(1e-7));
  CHECK(std::abs(with_mesh_stiffness(1e9).meshes[1].misalignment) < 1e-3 * std::abs(free));
  CHECK(std::isnan(with_mesh_stiffness(not_given).meshes[1].face_load_factor));
  const UnitState state = with_mesh_stiffness(2e4);
  // The line load at one end over the mean: c misalignment/2 over F/b.
  const double b = 50, F = std::hypot(state.meshes[1].force.x(), state.meshes[1].force.y());
  CHECK(state.meshes[1].face_load_factor == Approx(1 + 2e4 * std::abs(usual) / 2 / (F / b)).epsilon(in_unit));
  for (const ShaftState& shaft : state.shafts) CHECK(shaft.residual < in_unit);
  CHECK(std::abs(state.mesh_misalignment - with_mesh_stiffness(not_given).mesh_misalignment) > 1e-6);  // the pair under study feels it
  // Torques are what the balance says, whatever holds the tilt.
  CHECK(state.meshes[1].torque[0] == Approx(with_mesh_stiffness(not_given).meshes[1].torque[0]).epsilon(in_unit));
}

TEST_CASE("On the other flanks a helical pair's shafts are those of a pair of the other hand", "[core][compliance][shaft][unit]") {
  ShaftsOfPair shafts = two_stages();
  shafts.unit = {};
  shafts.shaft.pinion->torque_position = 0;
  const GearPair right = second_stage(WorkingFlank::Right, Hand::Right), left = second_stage(WorkingFlank::Right, Hand::Left);
  const std::vector<ContactPoint> points = unit_points(left);
  const Eigen::MatrixXd there = ShaftPair(left, shafts, on_shafts).influence(points, 0.0);
  CHECK(largest(ShaftPair(right, shafts, on_shafts).on_other_flanks()->influence(points, 0.0) - there) <= in_unit * largest(there));
  CHECK(largest(ShaftPair(right, shafts, on_shafts).influence(points, 0.0) - there) > 1e-3 * largest(there));
}

TEST_CASE("A spur unit with its axes in one plane bends under the other flanks as in a mirror", "[core][compliance][shaft][unit]") {
  ShaftsOfPair shafts = two_stages();
  shafts.unit.meshes[0].angle = 180 * units::deg;
  shafts.unit.meshes[0].helix_angle = 0.0;
  shafts.unit.meshes[0].centre_distance = 176;
  shafts.unit.meshes[0].stiffness = 2e4;
  shafts.unit.loads = {{"pinion", 130, {1500, 0, 0}, Eigen::Vector3d::Zero(), true}};
  shafts.shaft.pinion->bearings[0].stiffness_matrix = Eigen::Matrix<double, 5, 1>(4e5, 4e5, 3e5, 2e8, 2e8).asDiagonal();
  shafts.shaft.pinion->bearings[0].stiffness_matrix(0, 4) = shafts.shaft.pinion->bearings[0].stiffness_matrix(4, 0) = 2e6;
  shafts.shaft.pinion->bearings[0].radial_stiffness = std::numeric_limits<double>::infinity();
  shafts.shaft.pinion->bearings[0].axial_stiffness = 0.0;
  PairData data = pair_cases::pair_data(23, 34, 0, 6.5, 74);
  data.working_flank = WorkingFlank::Left;
  const ShaftPair drive(make_gear_pair(data), shafts, on_shafts);
  const UnitState own = drive.state(unit_torque), other = drive.reversed().state(unit_torque);
  CHECK(other.mesh_misalignment == Approx(own.mesh_misalignment).epsilon(in_unit));
  CHECK(other.meshes[1].torque[0] == Approx(-own.meshes[1].torque[0]).epsilon(in_unit));
  CHECK(other.meshes[1].misalignment == Approx(own.meshes[1].misalignment).epsilon(1e-8));
  CHECK(other.meshes[1].first_flank != own.meshes[1].first_flank);
  for (std::size_t i = 0; i < own.bearings.size(); ++i) {
    CHECK((other.bearings[i].force - in_mirror(own.bearings[i].force)).norm() <= 1e-8 * own.bearings[i].force.norm());
  }
}

TEST_CASE("Matrices, stiffnesses and loads that cannot be are refused by their key", "[core][compliance][shaft][unit]") {
  const auto with_matrix = [](const Eigen::MatrixXd& stiffness, double axial = 0.0) {
    ShaftsOfPair shafts = two_stages();
    ShaftBearing& bearing = shafts.shaft.pinion->bearings[0];
    bearing = {.position = bearing.position, .axial_stiffness = axial, .stiffness_matrix = stiffness};
    return refused_unit(shafts);
  };
  const Eigen::MatrixXd held = Eigen::Matrix<double, 5, 1>(4e5, 4e5, 3e5, 2e8, 2e8).asDiagonal();
  const std::string key = "pinion.shaft.bearings.0.stiffness_matrix";
  CHECK(with_matrix(held).empty());
  CHECK(with_matrix(held, 1e5) == key);
  CHECK(with_matrix(Eigen::MatrixXd::Ones(3, 3)) == key);
  Eigen::MatrixXd skew = held, loose = held, negative = held;
  skew(0, 4) = 1e6;
  loose.row(0).setZero();
  loose.col(0).setZero();
  negative(0, 4) = negative(4, 0) = 1e8;
  CHECK(with_matrix(skew) == key);
  CHECK(with_matrix(loose) == key);
  CHECK(with_matrix(negative) == key);
  ShaftsOfPair twisted = two_stages();
  twisted.unit.loads = {{"pinion", 130, Eigen::Vector3d::Zero(), {0, 0, 1e5}, true}};
  CHECK(refused_unit(twisted) == "unit.loads.0.torque");
  ShaftsOfPair faceless = two_stages();
  faceless.unit.meshes[0].stiffness = 2e4;
  faceless.unit.meshes[0].gears[1].face_width = 0.0;
  CHECK(refused_unit(faceless) == "unit.meshes.0.stiffness");
}
