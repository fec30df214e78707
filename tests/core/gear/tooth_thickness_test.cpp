#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/compliance/model/compliance_task.hpp"
#include "core/gear/gear_pair.hpp"
#include "core/gear/involute.hpp"
#include "core/gear/tooth_form.hpp"

using namespace flankwright;
using units::deg;
using units::pi;

namespace {

constexpr double kThicknessRoundOff = 1e-13;  // of lengths, relative to the centre distance

PairData thinned(double beta, double pinion_allowance, double wheel_allowance) {
  PairData data;
  data.normal_module = 3.0;
  data.helix_angle = beta;
  data.pinion.teeth = 19;
  data.wheel.teeth = 45;
  data.pinion.face_width = data.wheel.face_width = 30.0;
  data.pinion.profile_shift = 0.3;
  data.wheel.profile_shift = 0.1;
  data.pinion.tooth_thickness_allowance = pinion_allowance;
  data.wheel.tooth_thickness_allowance = wheel_allowance;
  return data;
}

/// The same teeth at the same centre distance, stated by the profile shift that generates them: no allowances.
PairData restated(const GearPair& pair) {
  PairData data = pair.data;
  data.centre_distance = pair.centre_distance;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    GearData& gear = m == Member::Pinion ? data.pinion : data.wheel;
    gear.profile_shift += gear.tooth_thickness_allowance / (2 * data.normal_module * std::tan(data.pressure_angle));
    gear.tooth_thickness_allowance = 0.0;
    gear.tip_diameter = 2 * pair[m].tip_radius;
  }
  return data;
}

}  // namespace

TEST_CASE("An allowance changes the base tangent length by its part along the normal and leaves the tip", "[core][gear][thickness][closed-form]") {
  const double beta = GENERATE(0.0, 24 * deg);
  const GearPair nominal = make_gear_pair(thinned(beta, 0.0, 0.0)), thin = make_gear_pair(thinned(beta, -0.08, -0.11));
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const double allowance = thin[m].data.tooth_thickness_allowance;
    // ISO 21771: the base tangent length takes E_sn cos(alpha_n) of it, and is the normal base thickness and base pitches.
    const auto base_thickness = [](const GearPair& pair, const Gear& gear) {
      return 2 * gear.base_radius * (0.5 * gear.tooth_thickness / gear.reference_radius + involute(pair.transverse_pressure_angle)) *
             std::cos(pair.base_helix_angle);
    };
    CHECK(std::abs(base_thickness(thin, thin[m]) - base_thickness(nominal, nominal[m]) - allowance * std::cos(20 * deg)) <=
          kThicknessRoundOff * thin.centre_distance);
    CHECK(thin[m].tip_radius == nominal[m].tip_radius);
    CHECK(std::abs(thin[m].root_radius - nominal[m].root_radius - allowance / (2 * std::tan(20 * deg))) <= kThicknessRoundOff * thin.centre_distance);
    CHECK(thin[m].tip_thickness < nominal[m].tip_thickness);
  }
  CHECK(thin.centre_distance == nominal.centre_distance);
  CHECK(thin.path_start == nominal.path_start);
  CHECK(thin.path_end == nominal.path_end);
}

TEST_CASE("Allowances leave their sum along the normal as normal backlash", "[core][gear][thickness][closed-form]") {
  const double beta = GENERATE(0.0, 24 * deg);
  const auto [of_pinion, of_wheel] = GENERATE(std::pair{-0.08, -0.11}, std::pair{-0.05, 0.0}, std::pair{0.0, -0.3});
  const PairData data = thinned(beta, of_pinion, of_wheel);
  const GearPair pair = make_gear_pair(data);
  const double round_off = kThicknessRoundOff * pair.centre_distance;
  // Both base tangent lengths are shorter by E_sn cos(alpha_n), and the line of action crosses them at right angles.
  CHECK(std::abs(pair.normal_backlash() + (of_pinion + of_wheel) * std::cos(20 * deg)) <= round_off);
  CHECK(std::abs(pair.backlash_at(pair.centre_distance) - pair.backlash) <= round_off);
  CHECK(std::abs(pair.backlash_at(pair.backlash_free_centre_distance)) <= round_off);
  CHECK(pair.radial_backlash() > 0.0);

  // A centre distance adds what it adds to the nominal teeth, its allowances the same in the ratio of the pitch circles.
  PairData apart = data, nominal = thinned(beta, 0.0, 0.0);
  apart.centre_distance = nominal.centre_distance = pair.centre_distance + 0.2;
  const GearPair both = make_gear_pair(apart);
  const double widened = make_gear_pair(nominal).backlash + pair.backlash * apart.centre_distance / pair.centre_distance;
  CHECK(std::abs(both.backlash - widened) <= round_off);

  PairData swapped = data;
  std::swap(swapped.pinion, swapped.wheel);
  const GearPair other = make_gear_pair(swapped);
  CHECK(std::abs(other.backlash - pair.backlash) <= round_off);
  CHECK(std::abs(other.backlash_free_centre_distance - pair.backlash_free_centre_distance) <= round_off);
}

TEST_CASE("A gear with an allowance is that of its generating profile shift, for every compliance", "[core][gear][thickness]") {
  const GearPair pair = make_gear_pair(thinned(24 * deg, -0.08, -0.11)), same = make_gear_pair(restated(pair));
  const double round_off = kThicknessRoundOff * pair.centre_distance;
  CHECK(std::abs(pair.backlash - same.backlash) <= round_off);
  CHECK(std::abs(pair.backlash_free_centre_distance - same.backlash_free_centre_distance) <= round_off);
  for (const ComplianceModel model : {ComplianceModel::Fitted, ComplianceModel::Fe}) {
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      CHECK(std::abs(pair[m].form_radius - same[m].form_radius) <= round_off);
      const InfluenceTableTask by_allowance = influence_table_task({.pair = pair, .model = model}, m);
      InfluenceTableTask by_shift = influence_table_task({.pair = same, .model = model}, m);
      by_shift.gear.gear.rack.addendum = by_allowance.gear.gear.rack.addendum;  // both have the tip diameter
      CHECK(alike_but_for_size(by_allowance, by_shift));
      // The library knows this rack's tip, as if it had the longer addendum.
      if (model == ComplianceModel::Fitted) CHECK(unknown_to_library({.pair = pair, .model = model}, by_allowance).empty());
    }
  }
}

TEST_CASE("An allowance that leaves no tooth is refused with the range that would", "[core][gear][thickness][errors]") {
  CHECK(find_problems(thinned(0.0, 0.01, 0.0)).front().field() == "pinion.tooth_thickness_allowance");
  const std::vector<InvalidInput> both = find_problems(thinned(0.0, -2.5, -3.0));
  REQUIRE(both.size() == 2);
  CHECK(both[0].field() == "pinion.tooth_thickness_allowance");
  CHECK(both[1].field() == "wheel.tooth_thickness_allowance");
  // At the tip the pinion's tooth is as thick as its allowance, seen from the axis, may be.
  const GearPair nominal = make_gear_pair(thinned(0.0, 0.0, 0.0));
  const Gear& pinion = nominal.pinion;
  const double least = -pinion.tip_thickness * pinion.reference_radius / pinion.tip_radius;
  CHECK(both[0].allowed().substr(0, 5) == in_words(least / units::um).substr(0, 5));
  PairData edge = thinned(0.0, least * (1.0 - 1e-9), 0.0);
  CHECK(find_problems(edge).empty());
  edge.pinion.tooth_thickness_allowance = least * (1.0 + 1e-9);
  CHECK(find_problems(edge).front().field() == "pinion.tooth_thickness_allowance");
  // Where something else is wrong, that is named.
  edge = thinned(0.0, -2.5, 0.0);
  edge.wheel.profile_shift = 3.0;
  CHECK(find_problems(edge).front().field() == "wheel.profile_shift");
}
