#include "core/compliance/shaft/shaft_pair.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/gear/pair_cases.hpp"
#include "tests/reference/eigenvalues.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;

namespace {

constexpr double kRoundOff = 1e-11;
constexpr double kFace = 60, kLength = 200;

GearPair pair_of(double helix_deg, Hand hand = Hand::Right, WorkingFlank flank = WorkingFlank::Right) {
  PairData data = pair_cases::pair_data(21, 54, helix_deg, 5, kFace);
  data.pinion_hand = hand;
  data.working_flank = flank;
  return make_gear_pair(data);
}

/// One solid diameter that the gear does not change, the gear in the middle, torque in at the first end.
ShaftData plain(double diameter = 60) {
  ShaftData shaft;
  shaft.sections = {{kLength, diameter}};
  shaft.bearings = {{.position = 0, .axial_stiffness = std::numeric_limits<double>::infinity()}, {.position = kLength}};
  shaft.gear_position = kLength / 2;
  shaft.torque_position = 0;
  shaft.gear_stiffens = false;
  return shaft;
}

ShaftData unsymmetrical() {
  ShaftData shaft = plain();
  shaft.sections = {{80, 60, 30}, {120, 55}};
  shaft.bearings = {{.position = 15, .radial_stiffness = 2e5, .axial_stiffness = 1e5}, {.position = 190, .radial_stiffness = 4e5}};
  shaft.gear_position = 90;
  shaft.gear_stiffens = true;
  return shaft;
}

std::vector<ContactPoint> points_of(const GearPair& pair, double phase = 1.2) {
  return contact_points(pair, PathOfContact(pair), {QuadratureRule::Gauss2, 4}, phase, true, -kFace / 2, kFace / 2);
}

/// The pitch point at mid face.
ContactPoint pitch_point(const GearPair& pair, double z = 0) {
  ContactPoint point;
  const PathOfContact path(pair);
  point.z = z;
  point.phase = (pair.pitch_point - path.roll_at_start) / path.base_pitch;
  return point;
}

}  // namespace

TEST_CASE("One force at the pitch point bends, shears, twists and shifts a plain shaft as in closed form", "[core][compliance][shaft][closed-form]") {
  const GearPair pair = pair_of(20);
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const ShaftData shaft = plain();
  const ShaftPair shafts(pair, member == Member::Pinion ? std::optional(shaft) : std::nullopt,
                         member == Member::Wheel ? std::optional(shaft) : std::nullopt, GearBodyIn::Shaft);
  const double E = shaft.material.youngs_modulus, nu = shaft.material.poissons_ratio, G = E / 2 / (1 + nu), d = 60, L = kLength;
  const double A = units::pi * d * d / 4, I = units::pi * std::pow(d, 4) / 64, J = 2 * I;
  const double kappa = 6 * (1 + nu) / (7 + 6 * nu);  // Cowper's, solid circle
  const double c = std::cos(pair.base_helix_angle), s = std::sin(pair.base_helix_angle);
  const Gear& gear = pair[member];
  const double bends = c * c * (std::pow(L, 3) / (48 * E * I) + L / (4 * kappa * G * A));
  const double twists = std::pow(c * gear.base_radius, 2) * (L / 2) / (G * J);
  const double shifts = s * s * (L / 2) / (E * A);
  // The axial force at the pitch radius turns the shaft at mid span.
  const double tilts = std::pow(s * gear.working_pitch_radius, 2) * (L / (12 * E * I) + 1 / (L * kappa * G * A));
  const double found = shafts.influence({pitch_point(pair)}, 0.0)(0, 0);
  CHECK(found == Approx(bends + twists + shifts + tilts).epsilon(kRoundOff));
  // At the quarter points, in a spur gear, only bending and torsion are left, the twist unlike on both sides of the torque.
  const GearPair spur = pair_of(0);
  const ShaftPair straight(spur, shaft, std::nullopt, GearBodyIn::Shaft);
  const Eigen::MatrixXd K = straight.influence({pitch_point(spur, -20), pitch_point(spur, 20)}, 0.0);
  const double per_turn = std::pow(spur.pinion.base_radius, 2) / (G * J);
  CHECK(K(1, 1) - K(0, 0) == Approx(40 * per_turn).epsilon(1e-9));  // round-off of the difference
}

TEST_CASE("The matrix of both shafts is symmetric, does no negative work and adds up", "[core][compliance][shaft]") {
  const GearPair pair = pair_of(20);
  const auto points = points_of(pair);
  const GearBodyIn body = GENERATE(GearBodyIn::Shaft, GearBodyIn::Structure);
  const ShaftPair both(pair, unsymmetrical(), plain(), body), pinion(pair, unsymmetrical(), std::nullopt, body),
      wheel(pair, std::nullopt, plain(), body);
  const Eigen::MatrixXd K = both.influence(points, 3.0);
  CHECK(K == K.transpose());
  CHECK((K - pinion.influence(points, 3.0) - wheel.influence(points, 3.0)).norm() < kRoundOff * K.norm());
  const Eigen::VectorXd values = symmetric_eigenvalues(K);
  CHECK(values.minCoeff() > -kRoundOff * values.maxCoeff());
  CHECK(both.has_shaft(Member::Wheel));
  CHECK_FALSE(pinion.has_shaft(Member::Wheel));
}

TEST_CASE("A mirrored pair on mirrored shafts yields the same", "[core][compliance][shaft]") {
  const GearPair pair = pair_of(20), mirrored = pair_of(20, Hand::Left);
  ShaftData shaft = unsymmetrical(), turned = shaft;
  std::ranges::reverse(turned.sections);
  for (ShaftBearing& bearing : turned.bearings) bearing.position = kLength - bearing.position;
  turned.gear_position = kLength - shaft.gear_position;
  turned.torque_position = kLength - shaft.torque_position;
  std::vector<ContactPoint> points = points_of(pair), mirror = points;
  for (ContactPoint& point : mirror) point.z = -point.z;
  for (const GearBodyIn body : {GearBodyIn::Shaft, GearBodyIn::Structure}) {
    const Eigen::MatrixXd K = ShaftPair(pair, shaft, shaft, body).influence(points, 0.0);
    const Eigen::MatrixXd other = ShaftPair(mirrored, turned, turned, body).influence(mirror, 0.0);
    CHECK((K - other).norm() < kRoundOff * K.norm());
    // The other flank of the other hand is the mirror image in the plane of the axes: nothing changes.
    const GearPair coast = pair_of(20, Hand::Left, WorkingFlank::Left);
    CHECK((ShaftPair(coast, shaft, shaft, body).influence(points, 0.0) - K).norm() < kRoundOff * K.norm());
  }
}

TEST_CASE("Where a load's moments act does not matter on a shaft that is rigid inside the gear", "[core][compliance][shaft]") {
  const GearPair pair = pair_of(20);
  ShaftData shaft = plain();
  shaft.sections = {{70, 60}, {60, 5000}, {70, 60}};  // yields 1e-7 as much as the rest
  const auto points = points_of(pair);
  const Eigen::MatrixXd here = ShaftPair(pair, shaft, std::nullopt, GearBodyIn::Shaft).influence(points, 0.0);
  const Eigen::MatrixXd there = ShaftPair(pair, shaft, std::nullopt, GearBodyIn::Structure).influence(points, 0.0);
  CHECK((here - there).norm() < 1e-5 * here.norm());  // model: shear over 60 mm of (60/5000)^2
}

TEST_CASE("A shaft's motion is what its matrix says of places on the pitch line", "[core][compliance][shaft]") {
  const GearPair pair = pair_of(0);
  const ShaftPair shafts(pair, unsymmetrical(), std::nullopt, GearBodyIn::Shaft);
  const std::vector<ContactPoint> points{pitch_point(pair, -kFace / 2), pitch_point(pair), pitch_point(pair, kFace / 2)};
  const Eigen::Vector3d forces(100, 250, 50);
  const Eigen::Vector3d moved = shafts.influence(points, 0.0) * forces;
  const ShaftMotion motion = shafts.motion(Member::Pinion, points, forces, 0.0);
  CHECK(motion.displacement == Approx(moved[1]).epsilon(kRoundOff));
  CHECK(motion.misalignment == Approx(moved[2] - moved[0]).epsilon(kRoundOff));
  CHECK(std::isnan(shafts.motion(Member::Wheel, points, forces, 0.0).displacement));
  // Torque from the first end winds the shaft up: the mesh opens towards the other, the more so the thinner it is.
  ShaftData stiff = plain(), soft = plain(50);
  const auto opens = [&](const ShaftData& shaft) {
    return ShaftPair(pair, shaft, std::nullopt, GearBodyIn::Shaft).motion(Member::Pinion, points, forces, 0.0).misalignment;
  };
  CHECK(opens(stiff) > 0.0);
  CHECK(opens(soft) > opens(stiff));
}

TEST_CASE("A shaft that cannot be is refused under the study's key", "[core][compliance][shaft]") {
  ShaftData shaft = plain();
  shaft.gear_position = 10;
  try {
    ShaftPair(pair_of(20), plain(), shaft, GearBodyIn::Shaft);
    FAIL("not refused");
  } catch (const InvalidInput& problem) {
    CHECK(problem.field() == "wheel.shaft.gear_position");
  }
}
