#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/flank/flank.hpp"
#include "core/flank/natural_twist.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

constexpr ModificationParameter the_compensation = parameter_of("twist_compensation");

/// Haddad's pair 18:54.
GearPair compensated_pair(double helix_angle_deg) { return pair_cases::pair(18, 54, helix_angle_deg, 10.0, 120.0); }

Modification compensated_lead(GrindingKind kind, double part) {
  Modification m;
  m.lead_crowning = 7 * units::um;
  m.lead_slope = -4 * units::um;
  m.end_relief = {8 * units::um, 20.0};
  m.tip_relief = {12 * units::um, 4.0};
  m.process = {kind, part};
  return m;
}

double compensated_radius(const Gear& gear, double share) { return std::lerp(gear.active_root_radius, gear.tip_form_radius, share); }

}  // namespace

TEST_CASE("A compensation is a parameter beside those of what is removed", "[core][flank][grinding]") {
  Modification m = compensated_lead(GrindingKind::GeneratingGrinding, 0.25);
  CHECK(get(m, the_compensation) == 0.25);
  set(m, the_compensation, 0.75);
  CHECK(m.process == GrindingProcess{GrindingKind::GeneratingGrinding, 0.75});
  CHECK(describe(the_compensation).key == "twist_compensation");
  CHECK(describe(the_compensation).kind == ParameterKind::Fraction);
  CHECK(find_parameter("twist_compensation") == nullptr);  // removes nothing itself
  CHECK(of_process(parameter_of("lead_crowning")) == nullptr);
}

TEST_CASE("The derivative by a compensation is that of the ground flank, and its slope that along the profile", "[core][flank][grinding][gradient]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GrindingKind kind = GENERATE(GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding);
  const double part = GENERATE(0.0, 0.3, 1.0);  // 1: nothing is twisted, but less compensation would twist
  const GearPair pair = compensated_pair(30);
  const Modification m = compensated_lead(kind, part);
  const GroundDerivative derivative = ground_derivative(pair, member, m, the_compensation);
  double largest = 0.0;
  for (const double share : {0.05, 0.4, 0.9}) {
    for (const double z : {-53.0, -20.0, 3.0, 52.0}) {
      const double r = compensated_radius(pair[member], share);
      const auto deviation = [&](double by) {
        Modification moved = m;
        set(moved, the_compensation, part + by);
        const Flank flank = make_flank(pair, member, moved, {});
        return flank.deviation(flank.roll_at(r), z, 0);
      };
      constexpr double step = 1e-4, along = 1e-3;
      const double by_differences = (deviation(step) - deviation(-step)) / (2 * step);
      const RemovalDerivative::WithSlope exact = derivative.with_slope(r, z);
      const double slope = (derivative.at(r + along, z) - derivative.at(r - along, z)) / (2 * along);
      CAPTURE(share, z, exact.value, by_differences, exact.slope, slope);
      constexpr double scale = 5 * units::um;
      // Quadratic in the compensation but for end relief, of which no start lies within the step: round-off. Of the slope the step's square as well.
      CHECK(std::abs(exact.value - by_differences) <= 1e-8 * scale);
      CHECK(std::abs(exact.slope - slope) <= 1e-6 * scale);
      CHECK(derivative.at(r, z) == exact.value);
      largest = std::max(largest, std::abs(exact.value));
    }
  }
  CHECK(largest > 2 * units::um);  // it is no small matter
}

TEST_CASE("Nothing that twists nothing has a derivative by its compensation", "[core][flank][grinding]") {
  const auto at_the_tip = [](const GearPair& pair, const Modification& m) {
    const GroundDerivative derivative = ground_derivative(pair, Member::Pinion, m, the_compensation);
    return derivative.at(compensated_radius(pair.pinion, 1.0), 50.0);
  };
  const GearPair helical = compensated_pair(30), spur = compensated_pair(0.0);
  CHECK(at_the_tip(helical, compensated_lead(GrindingKind::GeneratingGrinding, 0.5)) != 0.0);
  CHECK(at_the_tip(helical, compensated_lead(GrindingKind::None, 0.5)) == 0.0);
  CHECK(at_the_tip(helical, compensated_lead(GrindingKind::Topological, 0.5)) == 0.0);
  CHECK(at_the_tip(spur, compensated_lead(GrindingKind::GeneratingGrinding, 0.5)) == 0.0);
  Modification profile_alone;
  profile_alone.tip_relief = {12 * units::um, 4.0};
  profile_alone.process.kind = GrindingKind::GeneratingGrinding;
  CHECK(at_the_tip(helical, profile_alone) == 0.0);
}

TEST_CASE("The derivative by a compensation takes the twist away in proportion", "[core][flank][grinding][closed-form]") {
  // With crowning alone D = C (2/b)^2 ((z - (1 - c) h)^2 - z^2), so that dD/dc = 2 C (2/b)^2 (z - (1 - c) h) h with h = -tan(beta_b) (rho - rho_0).
  const GearPair pair = compensated_pair(30);
  Modification m;
  m.lead_crowning = 8 * units::um;
  m.process = {GrindingKind::GeneratingGrinding, 0.4};
  const Gear& gear = pair.pinion;
  const GroundDerivative derivative = ground_derivative(pair, Member::Pinion, m, the_compensation);
  const double middle = 0.5 * (gear.roll_length_at(gear.active_root_radius) + gear.roll_length_at(gear.tip_form_radius));
  const double sense = pair.flank_frame(Member::Pinion).helix_rate > 0.0 ? 1.0 : -1.0, b = 120.0;
  for (const double share : {0.1, 0.6, 1.0}) {
    for (const double z : {-60.0, 11.0, 60.0}) {
      const double r = compensated_radius(gear, share), h = -sense * std::tan(pair.base_helix_angle) * (gear.roll_length_at(r) - middle);
      constexpr double round_off = 1e-15;  // mm
      CHECK(derivative.at(r, z) == tests::about(2.0 * m.lead_crowning * (4.0 / (b * b)) * (z - 0.6 * h) * h, round_off));
    }
  }
}
