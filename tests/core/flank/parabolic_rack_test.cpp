#include <catch2/catch.hpp>
#include <cmath>

#include "core/flank/generated_field.hpp"
#include "core/gear/generation_check.hpp"
#include "tests/core/flank/rolling.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using units::deg;

namespace {

PairData data_of(double helix_angle) {
  PairData data;
  data.normal_module = 5.08;
  data.helix_angle = helix_angle;
  data.pinion_hand = Hand::Left;
  data.pinion.teeth = 30;
  data.wheel.teeth = 100;
  data.pinion.profile_shift = 0.2;
  data.pinion.face_width = data.wheel.face_width = 40.0;
  return data;
}

struct Generated {
  GearPair pair;
  Flank flank;
};

Generated generate(PairData data, Member member, double coefficient) {
  data[member].generation = ParabolicRack{coefficient};
  Generated made{make_gear_pair(data), {}};
  made.flank = make_flank(made.pair, member, {}, {});
  made.flank.fields = {make_generated_field(made.pair, member)};
  return made;
}

/// Roll length at a share of the flank, 0 at the form and 1 at the tip circle.
double roll_at(const Flank& flank, double share) { return flank.lowest_roll() + share * (flank.highest_roll() - flank.lowest_roll()); }

}  // namespace

TEST_CASE("A parabolic rack of coefficient zero leaves the involute, to the last bit", "[core][flank][closed-form]") {
  const auto [pair, flank] = generate(data_of(GENERATE(0.0, 25.0) * deg), Member::Pinion, 0.0);
  for (double share = -0.2; share <= 1.2; share += 0.05) {
    const Jet d = flank.fields.front()->at(roll_at(flank, share), 3.0);
    CHECK(d.value == 0.0);
    CHECK(d.u == 0.0);
    CHECK(d.uu == 0.0);
  }
}

TEST_CASE("To first order a parabolic rack removes its parabola, along the base tangent", "[core][flank][closed-form]") {
  const double helix_angle = GENERATE(0.0, 30.0) * deg;
  const auto first_order_error = [&](double coefficient) {
    const auto [pair, flank] = generate(data_of(helix_angle), Member::Wheel, coefficient);
    const double alpha_t = pair.transverse_pressure_angle;
    double worst = 0.0;
    for (double share = 0.0; share <= 1.0; share += 0.1) {
      const double rho = roll_at(flank, share);
      // The straight rack touches the involute u from its rolling line.
      const double u = (rho - pair.wheel.base_radius * std::tan(alpha_t)) * std::sin(alpha_t) / std::cos(pair.data.pressure_angle);
      const double d = flank.fields.front()->at(rho, 0.0).value;
      worst = std::max(worst, std::abs(d / coefficient - u * u / std::cos(pair.base_helix_angle)));
    }
    return worst;
  };
  const double coarse = first_order_error(2e-5), fine = first_order_error(1e-5);
  CHECK(fine < 0.1);  // mm^2 of some 100: model error of first order in a_c
  CHECK(coarse / fine == Approx(2.0).epsilon(0.02));
}

TEST_CASE("A parabolic rack cuts nowhere deeper than its flank and touches it once", "[core][flank]") {
  const double helix_angle = GENERATE(0.0, 15.0, 30.0) * deg;
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const Hand hand = GENERATE(Hand::Left, Hand::Right);
  const double coefficient = 1e-3;
  PairData data = data_of(helix_angle);
  data.pinion_hand = hand;
  const auto made = generate(data, member, coefficient);
  const GearPair& pair = made.pair;
  const Flank& flank = made.flank;
  const double sa = std::sin(data.pressure_angle), ca = std::cos(data.pressure_angle);
  const double tan_beta = flank.helix_rate * pair[member].reference_radius;  // with the hand's sign
  const double cos_beta = std::cos(helix_angle);
  // The rack in its normal section: u along the straight profile, and how far the point lies inside the cutting edge.
  const auto along = [&](const Eigen::Vector3d& p) { return p.x() * ca - (p.y() - p.z() * tan_beta) * cos_beta * sa; };
  const auto inside = [&](const Eigen::Vector3d& p) {
    const double u = along(p), out = p.x() * sa + (p.y() - p.z() * tan_beta) * cos_beta * ca;
    return -coefficient * u * u - out;
  };
  for (const double z : {-18.0, 0.0, 7.0}) {
    for (double share = 0.0; share <= 1.0; share += 0.125) {
      const SurfacePoint at = surface_point(flank, roll_at(flank, share), z, 0, 0.0);
      const Point3<double> p{at.position.x(), at.position.y(), z};
      // Equation of meshing: with the normal through the pitch point the point lies on the rack.
      const double contact = rolling::roll_of_normal(pair, member, at);
      CAPTURE(z, share, contact);
      CHECK(std::abs(inside(rolling::in_rack(pair, member, p, contact))) <= 1e-11);  // round-off on radii of 300 mm
      const auto clearance = [&](double roll) {
        const Eigen::Vector3d q = rolling::in_rack(pair, member, p, roll);
        return q.x() < rolling::tool_tip(pair, member) ? 1.0 : inside(q);
      };
      CHECK(std::abs(rolling::least(clearance, contact - 0.5, contact + 0.4)) <= 1e-11);
    }
  }
}

TEST_CASE("The spur flank of a parabolic rack satisfies the paper's equation of meshing", "[core][flank]") {
  const double coefficient = 1e-3;
  const auto [pair, flank] = generate(data_of(0.0), Member::Pinion, coefficient);
  const double sa = std::sin(pair.data.pressure_angle), ca = std::cos(pair.data.pressure_angle);
  for (double share = 0.0; share <= 1.0; share += 0.125) {
    const SurfacePoint at = surface_point(flank, roll_at(flank, share), 0.0, 0, 0.0);
    const double psi = rolling::roll_of_normal(pair, Member::Pinion, at);
    const Eigen::Vector3d p = rolling::in_rack(pair, Member::Pinion, {at.position.x(), at.position.y(), 0.0}, psi);
    const double u = -(p.x() * ca - p.y() * sa), a = coefficient;  // u_c of the paper runs to the root
    // TM-107451, A.5.14 with beta = 0; r_p1 psi_1 there counts from a_m.
    const double residual = pair.pinion.reference_radius * psi + u * (1 + 2 * a * a * u * u) / (sa - 2 * a * u * ca);
    CHECK(std::abs(residual) <= 1e-11);  // mm, round-off
  }
}

TEST_CASE("A parabolic rack leaves the reference circle and thins the tooth everywhere else", "[core][flank]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const auto [pair, flank] = generate(data_of(20 * deg), member, 1e-3);
  const double reference = pair[member].roll_length_at(pair[member].reference_radius);
  const Jet there = flank.fields.front()->at(reference, 5.0);
  CHECK(std::abs(there.value) <= 1e-14);  // round-off of a roll length of some 50 mm, squared
  CHECK(std::abs(there.u) <= 1e-14);
  double below = 0.0, above = 0.0;
  for (int i = 1; i <= 20; ++i) {
    const double down = flank.fields.front()->at(reference + i / 20.0 * (flank.lowest_roll() - reference), 0.0).value;
    const double up = flank.fields.front()->at(reference + i / 20.0 * (flank.highest_roll() - reference), 0.0).value;
    CHECK(down > below);
    CHECK(up > above);
    below = down;
    above = up;
  }
}

TEST_CASE("The derivatives of a rack-generated flank are those of its values, the same in every section", "[core][flank]") {
  const double helix_angle = GENERATE(0.0, 25.0) * deg;
  const auto [pair, flank] = generate(data_of(helix_angle), Member::Pinion, 1e-3);
  constexpr double kStep = 1e-3;            // mm
  constexpr double kDiscretisation = 1e-9;  // step^2 times third derivatives of 1e-4, round-off / step
  const DeviationField& field = *flank.fields.front();
  for (double share = 0.0; share <= 1.0; share += 0.1) {
    const double rho = roll_at(flank, share);
    const Jet at = field.at(rho, 2.0), below = field.at(rho - kStep, 2.0), above = field.at(rho + kStep, 2.0);
    CAPTURE(share);
    CHECK(std::abs(at.u - (above.value - below.value) / (2 * kStep)) <= kDiscretisation);
    CHECK(std::abs(at.uu - (above.u - below.u) / (2 * kStep)) <= kDiscretisation);
    CHECK(at.v == 0.0);
    CHECK(at.uv == 0.0);
    CHECK(at.vv == 0.0);
    CHECK(field.at(rho, -17.0).value == at.value);
  }
}

TEST_CASE("Beyond its ends a generated flank continues with value and slope", "[core][flank]") {
  const auto [pair, flank] = generate(data_of(0.0), Member::Pinion, 1e-3);
  const DeviationField& field = *flank.fields.front();
  const double end = 1.025 * flank.highest_roll();
  const Jet in = field.at(end * (1 - 1e-13), 0.0), out = field.at(end * (1 + 1e-13), 0.0), far = field.at(end + 3.0, 0.0);
  CHECK(std::abs(in.value - out.value) <= 1e-13);  // round-off
  CHECK(std::abs(in.u - out.u) <= 1e-13);
  CHECK(in.u > 1e-3);
  CHECK(far.u == Approx(out.u).epsilon(1e-12));
  CHECK(far.value == Approx(out.value + 3.0 * out.u).epsilon(1e-11));
  CHECK(std::isfinite(field.at(-5.0, 0.0).value));
}

TEST_CASE("At the largest coefficient the flank still grows smoothly thinner from the reference circle", "[core][flank]") {
  const int teeth = GENERATE(17, 20, 40);
  PairData data = data_of(GENERATE(0.0, 30.0) * deg);
  data.pinion.teeth = teeth;
  const double limit = largest_parabola_coefficient(make_gear_pair(data).pinion, data);
  const auto [pair, flank] = generate(data, Member::Pinion, limit);
  const DeviationField& field = *flank.fields.front();
  const double reference = pair.pinion.roll_length_at(pair.pinion.reference_radius);
  // Where the tool undercuts above the form circle the flank continues by its tangent, and stays convex.
  Jet before = field.at(reference, 0.0);
  const double step = (reference - flank.lowest_roll()) / 200;
  for (int i = 1; i <= 200; ++i) {
    const Jet here = field.at(reference - i * step, 0.0);
    CAPTURE(i, here.value, here.u);
    REQUIRE(here.value > before.value);
    REQUIRE(here.u <= before.u);
    REQUIRE(here.value - before.value <= -step * here.u * (1 + 1e-9));  // round-off
    before = here;
  }
  CHECK(before.value < 1.0);  // mm: a fold shows as a jump
}
