#include "core/flank/flank.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/common/random.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using units::deg;
using units::pi;

namespace {

constexpr double kRoundOff = 1e-12;  // mm on radii of some 100 mm, or rad

GearPair nasa_pair(Hand hand, WorkingFlank flank) {
  PairData data = reference::nasa_tm_107451::pair_data();
  data.pinion_hand = hand;
  data.working_flank = flank;
  return make_gear_pair(data);
}

Modification strong_modification(ReliefShape shape) {
  Modification m;
  m.lead_crowning = 0.02;
  m.lead_slope = -0.01;
  m.addendum_crowning = 0.015;
  m.profile_slope = 0.006;
  m.tip_relief = {0.05, 1.5, shape};
  m.root_relief = {0.03, 1.2, shape};
  m.end_relief = {0.02, 6.0};
  m.twist = 0.01;
  return m;
}

Eigen::Vector3d position(const Point3<Dual<2>>& p) { return {p.x.value, p.y.value, p.z.value}; }
Eigen::Vector3d tangent(const Point3<Dual<2>>& p, int i) { return {p.x.gradient[i], p.y.gradient[i], p.z.gradient[i]}; }

}  // namespace

TEST_CASE("The unmodified flank unwinds from its base cylinder", "[core][flank][closed-form]") {
  const Hand hand = GENERATE(Hand::Right, Hand::Left);
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = nasa_pair(hand, WorkingFlank::Right);
  const Flank flank = make_flank(pair, member, {}, {});
  const double rb = flank.base_radius, z = 7.0, turned = 0.3;
  const Point3<double> start = flank_point(flank, 0.0, z, 0, turned);
  CHECK(std::abs(std::hypot(start.x, start.y) - rb) <= kRoundOff);
  for (double rho = 1.0; rho < 60.0; rho += 4.3) {
    const Point3<double> p = flank_point(flank, rho, z, 0, turned);
    const double radius = std::hypot(p.x, p.y);
    // The thread leaves the base circle at T, where the polar angle falls short of the point's by acos(r_b/r).
    const double at_t = std::atan2(p.y, p.x) - std::acos(rb / radius);
    const double arc = rb * (std::atan2(start.y, start.x) - at_t);
    const double thread = std::sqrt(radius * radius - rb * rb);
    CAPTURE(rho);
    CHECK(std::abs(thread - arc) <= 1e-10);  // round-off: the square root loses r/rho digits
    CHECK(std::abs(thread - rho) <= 1e-10);
  }
}

TEST_CASE("The unmodified flank is a helicoid of the reference helix angle and the gear's hand", "[core][flank]") {
  const Hand hand = GENERATE(Hand::Right, Hand::Left);
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = nasa_pair(hand, WorkingFlank::Right);
  const Flank flank = make_flank(pair, member, {}, {});
  const Gear& gear = pair[member];
  const double turn_per_mm = (gear.hand == Hand::Right ? 1.0 : -1.0) * std::tan(pair.data.helix_angle) / gear.reference_radius;
  for (const double z : {-20.0, 3.0, 19.0}) {
    const Point3<double> there = flank_point(flank, 40.0, z, 0, 0.0);
    const Point3<double> here = flank_point(flank, 40.0, 0.0, 0, z * turn_per_mm);
    CHECK(std::hypot(there.x - here.x, there.y - here.y) <= kRoundOff);
    CHECK(there.z == z);
  }
}

TEST_CASE("At rotation 0 the nominal flanks pass through the pitch point", "[core][flank]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  PairData data = reference::nasa_tm_107451::pair_data();
  data.pinion.profile_shift = 0.3;
  const GearPair pair = make_gear_pair(data);
  const Flank flank = make_flank(pair, member, {}, {});
  const double r_w = pair[member].working_pitch_radius;
  const Point3<double> p = flank_point(flank, flank.roll_at(r_w), 0.0, 0, 0.0);
  CHECK(std::abs(p.x - r_w) <= kRoundOff);
  CHECK(std::abs(p.y) <= kRoundOff);
}

TEST_CASE("The helicoid's normal lies in the base tangent plane, tilted by the base helix angle", "[core][flank]") {
  const Hand hand = GENERATE(Hand::Right, Hand::Left);
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = nasa_pair(hand, WorkingFlank::Right);
  const Flank flank = make_flank(pair, member, {}, {});
  const double sense = pair[member].hand == Hand::Right ? 1.0 : -1.0;
  for (const double rho : {20.0, 34.0, 50.0}) {
    for (const double z : {-18.0, 0.0, 11.0}) {
      const auto p = flank_point(flank, Dual<2>::variable(rho, 0), Dual<2>::variable(z, 1), 0, 0.1);
      const Eigen::Vector3d n = tangent(p, 1).cross(tangent(p, 0)).normalized();
      // Direction of the thread: from T on the base circle to the point.
      const Eigen::Vector3d at = position(p);
      const double theta = std::atan2(at.y(), at.x()) - std::atan2(rho, flank.base_radius);
      const Eigen::Vector3d thread(-std::sin(theta), std::cos(theta), 0.0);
      const double beta_b = pair.base_helix_angle;
      const Eigen::Vector3d expected = std::cos(beta_b) * thread - sense * std::sin(beta_b) * Eigen::Vector3d::UnitZ();
      CHECK((n - expected).norm() <= kRoundOff);
    }
  }
}

TEST_CASE("A removal moves the flank along its base tangent by exactly its amount", "[core][flank]") {
  const GearPair pair = nasa_pair(Hand::Left, WorkingFlank::Right);
  const Modification m = strong_modification(ReliefShape::Linear);
  ManufacturingError error;
  error.pitch_step = 0.004;
  const Flank plain = make_flank(pair, Member::Pinion, {}, {});
  const Flank changed = make_flank(pair, Member::Pinion, m, error);
  for (const double rho : {22.0, 35.0, 48.0}) {
    for (const double z : {-19.0, 2.0, 17.0}) {
      const double r = std::hypot(plain.base_radius, rho);
      const double removed = removal(m, plain.frame, r, z) - 2 * error.pitch_step;
      const Point3<double> a = flank_point(plain, rho, z, 2, 0.0), b = flank_point(changed, rho, z, 2, 0.0);
      const double theta = std::atan2(a.y, a.x) - std::atan2(rho, plain.base_radius);
      CHECK(std::abs(b.x - a.x - removed * std::sin(theta)) <= kRoundOff);
      CHECK(std::abs(b.y - a.y + removed * std::cos(theta)) <= kRoundOff);
    }
  }
}

TEST_CASE("The rotation through a point undoes the flank's own parametrisation", "[core][flank]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const ReliefShape shape = GENERATE(ReliefShape::Linear, ReliefShape::Parabolic);
  const GearPair pair = nasa_pair(Hand::Right, WorkingFlank::Right);
  ManufacturingError error;
  error.helix_slope = 0.01;
  error.profile_slope = -0.008;
  error.cumulative_pitch = {0.0, 0.004, -0.003};
  const Flank flank = make_flank(pair, member, strong_modification(shape), error);
  tests::Random random(20250101);
  for (int i = 0; i < 2000; ++i) {
    const double rho = random(flank.lowest_roll() + 0.1, flank.highest_roll());
    const double z = random(-flank.face.half(), flank.face.half()), rotation = random(-0.5, 0.5);
    const int tooth = static_cast<int>(random(-3.0, 4.0));
    const Point3<double> p = flank_point(flank, rho, z, tooth, rotation);
    const FlankThroughPoint<double> found = rotation_through(flank, p, tooth);
    if (std::abs(found.rotation - rotation) > kRoundOff) {
      CAPTURE(rho, z, tooth, rotation, found.rotation);
      FAIL("the flank does not pass through its own point");
    }
    REQUIRE(std::abs(found.radius - std::hypot(p.x, p.y)) <= kRoundOff);
  }
}

TEST_CASE("The rotation through a point has the exact gradient", "[core][flank]") {
  const GearPair pair = nasa_pair(Hand::Left, WorkingFlank::Right);
  const Flank flank = make_flank(pair, Member::Wheel, strong_modification(ReliefShape::Parabolic), {});
  const auto at = [&](double x, double y, double z) { return rotation_through(flank, Point3<double>{x, y, z}, 1).rotation; };
  constexpr double kStep = 1e-3;            // mm
  constexpr double kDiscretisation = 1e-9;  // rad/mm: step^2 times third derivatives of about 1e-5 rad/mm^3, round-off/step
  for (const double radius : {285.0, 292.3, 297.6}) {
    const double x = radius * std::cos(0.04), y = radius * std::sin(0.04), z = 5.0;
    using Number = Dual<3>;
    const auto found = rotation_through(flank, Point3<Number>{Number::variable(x, 0), Number::variable(y, 1), Number::variable(z, 2)}, 1);
    const Eigen::Vector3d expected((at(x + kStep, y, z) - at(x - kStep, y, z)) / (2 * kStep),
                                   (at(x, y + kStep, z) - at(x, y - kStep, z)) / (2 * kStep),
                                   (at(x, y, z + kStep) - at(x, y, z - kStep)) / (2 * kStep));
    CAPTURE(radius, found.rotation.gradient.transpose(), expected.transpose());
    CHECK((found.rotation.gradient - expected).norm() <= kDiscretisation);
  }
}
