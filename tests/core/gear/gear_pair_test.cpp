#include "core/gear/gear_pair.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "core/gear/involute.hpp"
#include "tests/reference/haddad_18_54.hpp"
#include "tests/reference/nasa_tm_107451.hpp"

using namespace flankwright;
using units::deg;
using units::pi;

namespace {

constexpr double kPairRoundOff = 1e-13;  // relative: a handful of trigonometric functions

PairData pair_of(int z1, int z2, double module, double beta, double x1 = 0.0, double x2 = 0.0) {
  PairData data;
  data.normal_module = module;
  data.helix_angle = beta;
  data.pinion.teeth = z1;
  data.wheel.teeth = z2;
  data.pinion.profile_shift = x1;
  data.wheel.profile_shift = x2;
  data.pinion.face_width = 10.0 * module;
  data.wheel.face_width = 9.0 * module;
  return data;
}

bool near(double found, double expected, double relative = kPairRoundOff) {
  INFO("found " << found << ", expected " << expected);
  return std::abs(found - expected) <= relative * std::abs(expected);
}

/// Angle between the centre line of a tooth and its flank, carried from the reference circle to radius r by integrating
/// d(angle)/dr = -tan(alpha_y)/r along the flank (Simpson): no involute function.
double half_angle_by_integration(double thickness, double reference, double base, double r) {
  constexpr int kIntervals = 2000;
  const auto slope = [base](double at) { return std::sqrt(at * at - base * base) / (base * at); };
  const double h = (r - reference) / kIntervals;
  double integral = slope(reference) + slope(r);
  for (int i = 1; i < kIntervals; ++i) integral += (i % 2 == 1 ? 4.0 : 2.0) * slope(reference + i * h);
  return 0.5 * thickness / reference - integral * h / 3.0;
}

std::vector<std::string> refused_fields(const PairData& data) {
  std::vector<std::string> names;
  for (const InvalidInput& problem : find_problems(data)) {
    CHECK_FALSE(problem.allowed().empty());
    names.push_back(problem.field());
  }
  return names;
}

bool names(const PairData& data, const std::string& field) {
  const std::vector<std::string> found = refused_fields(data);
  CHECK_THROWS_AS(make_gear_pair(data), InvalidInput);
  return std::find(found.begin(), found.end(), field) != found.end();
}

}  // namespace

TEST_CASE("A pair without profile shift has the radii and angles of its standard rack", "[core][gear][closed-form]") {
  const double beta = GENERATE(0.0, 15 * deg, 30 * deg);
  const double module = GENERATE(0.5, 4.0, 25.0);
  const GearPair pair = make_gear_pair(pair_of(23, 61, module, beta));
  const double alpha_t = std::atan(std::tan(20 * deg) / std::cos(beta));
  CHECK(near(pair.centre_distance, 0.5 * 84 * module / std::cos(beta)));
  CHECK(near(pair.working_transverse_pressure_angle, alpha_t));
  CHECK(near(pair.pinion.tip_radius, 0.5 * 23 * module / std::cos(beta) + module));
  CHECK(near(pair.wheel.root_radius, 0.5 * 61 * module / std::cos(beta) - 1.25 * module));
  CHECK(near(pair.pinion.tooth_thickness, 0.5 * pi * module / std::cos(beta)));
  CHECK(near(pair.transverse_base_pitch, pi * module / std::cos(beta) * std::cos(alpha_t)));
  // ISO 21771: sin(beta_b) = sin(beta) cos(alpha_n), a relation the program does not use.
  CHECK(std::abs(std::sin(pair.base_helix_angle) - std::sin(beta) * std::cos(20 * deg)) <= kPairRoundOff);
  CHECK(std::abs(pair.backlash) <= kPairRoundOff * module * 100);
  CHECK(pair.face_width == 9.0 * module);
  // Transverse contact ratio from the tip pressure angles; overlap ratio from the normal pitch.
  const auto gain = [&](const Gear& gear) {
    return gear.data.teeth / (2 * pi) * (std::tan(std::acos(gear.base_radius / gear.tip_radius)) - std::tan(alpha_t));
  };
  CHECK(near(pair.transverse_contact_ratio, gain(pair.pinion) + gain(pair.wheel), 1e-12));
  CHECK(std::abs(pair.overlap_ratio - pair.face_width * std::sin(beta) / (pi * module)) <= kPairRoundOff * 10);
}

TEST_CASE("Profile-shifted flanks fill the working pitch circle without backlash", "[core][gear][closed-form]") {
  const double beta = GENERATE(0.0, 22 * deg);
  const auto shifts = GENERATE(std::make_pair(0.4, 0.1), std::make_pair(0.5, -0.5), std::make_pair(-0.1, -0.3));
  const GearPair pair = make_gear_pair(pair_of(19, 45, 3.0, beta, shifts.first, shifts.second));
  const double alpha_w = pair.working_transverse_pressure_angle;
  CHECK(near(pair.centre_distance * std::cos(alpha_w), pair.pinion.base_radius + pair.wheel.base_radius));
  double filled = 0.0;
  for (const Gear& gear : {pair.pinion, pair.wheel}) {
    const double thickness = 3.0 * (0.5 * pi + 2 * gear.data.profile_shift * std::tan(20 * deg)) / std::cos(beta);
    const double r_w = gear.base_radius / std::cos(alpha_w);
    CHECK(near(gear.working_pitch_radius, r_w));
    filled += 2 * r_w * half_angle_by_integration(thickness, gear.reference_radius, gear.base_radius, r_w);
  }
  CHECK(near(filled, 2 * pi * pair.pinion.working_pitch_radius / 19, 1e-12));  // discretisation: Simpson, h^4 ~ 1e-14
  if (shifts.first + shifts.second == 0.0) CHECK(near(pair.centre_distance, 0.5 * 64 * 3.0 / std::cos(beta)));
}

TEST_CASE("A centre distance that leaves the tips no room is named itself, not the profile shifts", "[core][gear][errors]") {
  PairData data;
  data.normal_module = 3.0;
  data.pinion.teeth = 20;
  data.wheel.teeth = 40;
  data.pinion.face_width = data.wheel.face_width = 20.0;
  data.pinion.profile_shift = 0.2;
  const GearPair tight = make_gear_pair(data);
  // The tips reach the roots when the axes are closer by the tip clearance.
  const double clearance = tight.centre_distance - tight.wheel.tip_radius - tight.pinion.root_radius;
  data.centre_distance = tight.centre_distance - 1.01 * clearance;
  const std::vector<InvalidInput> problems = find_problems(data);
  REQUIRE(!problems.empty());
  for (const InvalidInput& problem : problems) CHECK(problem.field() == "pair.centre_distance");
  CHECK(problems.front().allowed().find("the teeth have no backlash") != std::string::npos);
  data.centre_distance = tight.centre_distance - 0.99 * clearance;
  CHECK(find_problems(data).empty());  // they jam, and are analysed all the same
}

TEST_CASE("A wider centre distance opens the backlash by twice its involute difference", "[core][gear][closed-form]") {
  PairData data = pair_of(19, 45, 3.0, 17 * deg, 0.2, 0.1);
  const GearPair tight = make_gear_pair(data);
  const double apart = GENERATE(-0.05, 0.1, 0.6);
  data.centre_distance = tight.centre_distance + apart;
  const GearPair pair = make_gear_pair(data);
  const double alpha = std::acos((tight.pinion.base_radius + tight.wheel.base_radius) / data.centre_distance);
  const double expected = 2 * data.centre_distance * (involute(alpha) - involute(tight.working_transverse_pressure_angle));
  CHECK(std::abs(pair.backlash - expected) <= 1e-12 * data.centre_distance);
  CHECK((pair.backlash > 0.0) == (apart > 0.0));
  CHECK(pair.backlash_free_centre_distance == tight.centre_distance);
  CHECK(pair.transverse_base_pitch == tight.transverse_base_pitch);
}

TEST_CASE("The path of contact joins the tip circles, the pitch point and both base tangent points", "[core][gear]") {
  const GearPair pair = make_gear_pair(pair_of(31, 31, 2.0, 10 * deg, 0.3, 0.0));
  CHECK(near(pair.path_length, pair.pinion.base_radius * std::tan(pair.working_transverse_pressure_angle) +
                                   pair.wheel.base_radius * std::tan(pair.working_transverse_pressure_angle)));
  CHECK(near(std::hypot(pair.pinion.base_radius, pair.path_end), pair.pinion.tip_radius));
  CHECK(near(std::hypot(pair.wheel.base_radius, pair.path_length - pair.path_start), pair.wheel.tip_radius));
  CHECK(near(std::hypot(pair.pinion.base_radius, pair.path_start), pair.pinion.active_root_radius));
  CHECK(near(std::hypot(pair.pinion.base_radius, pair.pitch_point), pair.pinion.working_pitch_radius));
  CHECK_FALSE(pair.pinion.fillet_interference);
  CHECK(pair.pinion.active_root_radius > pair.pinion.form_radius);
}

TEST_CASE("Haddad's 18:54 pair has the published radii and path of contact", "[core][gear][reference]") {
  namespace published = reference::haddad_18_54;
  const GearPair pair = make_gear_pair(published::pair_data());
  CHECK(std::abs(pair.pinion.tip_radius - published::pinion_tip_radius) <= published::half_digit_3);  // model: as printed
  CHECK(std::abs(pair.wheel.tip_radius - published::wheel_tip_radius) <= published::half_digit_3);
  CHECK(std::abs(pair.transverse_base_pitch - published::transverse_base_pitch) <= published::half_digit_4);
  CHECK(std::abs(pair.path_length - published::tangent_to_tangent) <= published::half_digit_4);
  CHECK(std::abs(pair.path_start - published::roll_at_path_start) <= published::half_digit_4);
  CHECK(std::abs(pair.transverse_contact_ratio - (published::path_end - published::path_start)) <= published::half_digit_5);
}

TEST_CASE("The NASA pair keeps the relations of its report's appendix 2", "[core][gear][reference]") {
  namespace published = reference::nasa_tm_107451;
  const GearPair pair = make_gear_pair(published::pair_data());
  const double r_p1 = 30 * units::inch / (2 * 5 * std::sin(published::lead_angle));        // A.2.5
  const double alpha_t = std::atan(std::tan(20 * deg) / std::sin(published::lead_angle));  // A.2.1
  const double tan_lambda_b = std::tan(published::lead_angle) / std::cos(alpha_t);         // A.2.7
  CHECK(near(pair.pinion.reference_radius, r_p1));
  CHECK(near(pair.pinion.base_radius, r_p1 * std::cos(alpha_t)));                   // A.2.6
  CHECK(near(1 / pair.pinion.helix_rate, r_p1 * std::tan(published::lead_angle)));  // A.2.8, both forms
  CHECK(near(1 / pair.pinion.helix_rate, pair.pinion.base_radius * tan_lambda_b));
  CHECK(near(pair.pinion.helix_rate / pair.wheel.helix_rate, 100.0 / 30.0));  // A.2.10
  CHECK(pair.overlap_ratio > 1.0);
}

TEST_CASE("Tooth thickness at tip and elsewhere is the distance of the two flanks", "[core][gear]") {
  const double x = GENERATE(-0.2, 0.0, 0.6);
  const double beta = GENERATE(0.0, 25 * deg);
  const GearPair pair = make_gear_pair(pair_of(21, 40, 5.0, beta, x, 0.0));
  const Gear& gear = pair.pinion;
  for (const double r : {gear.reference_radius * 1.001, 0.5 * (gear.reference_radius + gear.tip_radius), gear.tip_radius}) {
    const double half = half_angle_by_integration(gear.tooth_thickness, gear.reference_radius, gear.base_radius, r);
    CHECK(near(gear.tooth_thickness_at(r), 2 * r * half, 1e-11));  // discretisation: Simpson
  }
  CHECK(gear.tip_thickness == gear.tooth_thickness_at(gear.tip_radius));
}

TEST_CASE("The two gears have opposite hands and the line of contact follows hand and flank", "[core][gear]") {
  PairData data = pair_of(20, 30, 2.0, 20 * deg);
  CHECK(make_gear_pair(data).contact_line_sense() == 1);
  CHECK(make_gear_pair(data).wheel.hand == Hand::Left);
  data.working_flank = WorkingFlank::Left;
  CHECK(make_gear_pair(data).contact_line_sense() == -1);
  data.pinion_hand = Hand::Left;
  CHECK(make_gear_pair(data).contact_line_sense() == 1);
  CHECK(make_gear_pair(data).wheel.hand == Hand::Right);
  data.helix_angle = 0.0;
  CHECK(make_gear_pair(data).contact_line_sense() == 0);
}

TEST_CASE("Contact of an undercut pinion ends at its form circle", "[core][gear]") {
  const GearPair pair = make_gear_pair(pair_of(10, 60, 3.0, 0.0));
  CHECK(pair.pinion.undercut);
  CHECK(pair.pinion.fillet_interference);
  CHECK(pair.pinion.active_root_radius >= pair.pinion.form_radius * (1 - kPairRoundOff));
  CHECK(pair.path_start >= 0.0);
  CHECK(pair.path_start > pair.path_length - pair.wheel.roll_length_at(pair.wheel.tip_radius));
}

TEST_CASE("A gear that cannot be built is refused by the name of its field", "[core][gear][invalid-input]") {
  const PairData good = pair_of(20, 50, 3.0, 15 * deg);
  CHECK(refused_fields(good).empty());
  const auto with = [&](const std::function<void(PairData&)>& change) {
    PairData data = good;
    change(data);
    return data;
  };
  CHECK(names(with([](PairData& d) { d.pinion.teeth = 2; }), "pinion.teeth"));
  CHECK(names(with([](PairData& d) { d.wheel.teeth = -3; }), "wheel.teeth"));
  CHECK(names(with([](PairData& d) { d.pinion.face_width = -1.0; }), "pinion.face_width"));
  CHECK(names(with([](PairData& d) { d.wheel.face_width = 0.0; }), "wheel.face_width"));
  CHECK(names(with([](PairData& d) { d.normal_module = -2.0; }), "pair.normal_module"));
  CHECK(names(with([](PairData& d) { d.pressure_angle = 5 * deg; }), "pair.pressure_angle"));
  CHECK(names(with([](PairData& d) { d.helix_angle = 60 * deg; }), "pair.helix_angle"));
  CHECK(names(with([](PairData& d) { d.centre_distance = 100.0; }), "pair.centre_distance"));  // base radii: 101.7 mm
  CHECK(names(with([](PairData& d) { d.centre_distance = 114.5; }), "pair.centre_distance"));  // out of mesh
  CHECK(names(with([](PairData& d) {                                                           // the tip circles do not meet, whatever the overlap
                d.centre_distance = 116.0;
                d.pinion.face_width = d.wheel.face_width = 300.0;
              }),
              "pair.centre_distance"));
  CHECK(names(with([](PairData& d) { d.wheel.rack.root_radius = 0.6; }), "wheel.rack.root_radius"));
  CHECK(names(with([](PairData& d) { d.pinion.rack.addendum = 0.0; }), "pinion.rack.addendum"));
  // Pointed: 12 teeth shifted by 1.2; the mate's own thickness is fine.
  const PairData pointed = pair_of(12, 50, 3.0, 0.0, 1.2);
  CHECK(names(pointed, "pinion.profile_shift"));
  CHECK_FALSE(names(pointed, "wheel.profile_shift"));
  // The wheel's tip digs into the pinion's root.
  CHECK(names(with([](PairData& d) { d.wheel.tip_diameter = 164.0; }), "wheel.tip_diameter"));
  // A tip below the form circle leaves no flank.
  CHECK(names(with([](PairData& d) { d.wheel.tip_diameter = 140.0; }), "wheel.tip_diameter"));
}

TEST_CASE("A number that is none is refused in every field", "[core][gear][invalid-input]") {
  const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const std::vector<std::pair<std::string, std::function<void(PairData&, double)>>> sets{
      {"pair.normal_module", [](PairData& d, double v) { d.normal_module = v; }},
      {"pair.pressure_angle", [](PairData& d, double v) { d.pressure_angle = v; }},
      {"pair.helix_angle", [](PairData& d, double v) { d.helix_angle = v; }},
      {"pinion.face_width", [](PairData& d, double v) { d.pinion.face_width = v; }},
      {"wheel.profile_shift", [](PairData& d, double v) { d.wheel.profile_shift = v; }},
      {"wheel.rack.addendum", [](PairData& d, double v) { d.wheel.rack.addendum = v; }},
      {"pinion.rack.dedendum", [](PairData& d, double v) { d.pinion.rack.dedendum = v; }},
      {"pinion.rack.root_radius", [](PairData& d, double v) { d.pinion.rack.root_radius = v; }},
  };
  for (const auto& [field, apply] : sets) {
    PairData data = pair_of(20, 50, 3.0, 15 * deg);
    apply(data, bad);
    CAPTURE(field, bad);
    CHECK(names(data, field));
  }
  PairData data = pair_of(20, 50, 3.0, 15 * deg);
  data.pinion.tip_diameter = data.centre_distance = std::numeric_limits<double>::infinity();
  CHECK(names(data, "pinion.tip_diameter"));
}

TEST_CASE("Several mistakes are reported at once and the first is thrown", "[core][gear][invalid-input]") {
  PairData data = pair_of(2, 50, -3.0, 15 * deg);
  data.wheel.face_width = -1.0;
  const std::vector<std::string> found = refused_fields(data);
  for (const char* field : {"pair.normal_module", "pinion.teeth", "pinion.face_width", "wheel.face_width"}) {
    CAPTURE(field);
    CHECK(std::find(found.begin(), found.end(), field) != found.end());
  }
  try {
    make_gear_pair(data);
    FAIL("accepted");
  } catch (const InvalidInput& problem) {
    CHECK(problem.field() == found.front());
  }
}
