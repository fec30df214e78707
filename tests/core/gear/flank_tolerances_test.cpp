#include "core/gear/flank_tolerances.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/gear/pair_cases.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace flankwright;

namespace {

constexpr double round_off = 1e-13;

// Numbers that make every root whole.
const ToleranceData whole_roots{40, 400.0, 10.0, 100.0, 0.0};

double um(double mm) { return mm / units::um; }

}  // namespace

TEST_CASE("Flank tolerances of class 5 are the standard's sums done by hand", "[core][gear][iso1328]") {
  const FlankTolerances t = flank_tolerances(whole_roots, 5);
  CHECK(um(t.single_pitch) == Approx(9.4).epsilon(round_off));       // 0.4 + 4 + 5
  CHECK(um(t.cumulative_pitch) == Approx(30.8).epsilon(round_off));  // 0.8 + 11 + 7 + 12
  CHECK(um(t.profile_slope) == Approx(8.4).epsilon(round_off));      // 4 + 0.4 + 4
  CHECK(um(t.profile_form) == Approx(10.5).epsilon(round_off));      // 5.5 + 5
  CHECK(um(t.helix_slope) == Approx(8.5).epsilon(round_off));        // 1 + 3.5 + 4
  CHECK(um(t.helix_form) == Approx(9.9).epsilon(round_off));         // 1.4 + 4.5 + 4
  CHECK(um(t.profile_total) == Approx(std::sqrt(8.4 * 8.4 + 10.5 * 10.5)).epsilon(round_off));
  CHECK(um(t.helix_total) == Approx(std::sqrt(8.5 * 8.5 + 9.9 * 9.9)).epsilon(round_off));
}

TEST_CASE("Two classes up double every flank tolerance", "[core][gear][iso1328]") {
  for (int a = 1; a <= 9; ++a) {
    const FlankTolerances fine = flank_tolerances(whole_roots, a), coarse = flank_tolerances(whole_roots, a + 2);
    for (double FlankTolerances::*of :
         {&FlankTolerances::single_pitch, &FlankTolerances::cumulative_pitch, &FlankTolerances::profile_slope, &FlankTolerances::profile_form,
          &FlankTolerances::profile_total, &FlankTolerances::helix_slope, &FlankTolerances::helix_form, &FlankTolerances::helix_total}) {
      CHECK(coarse.*of == Approx(2.0 * fine.*of).epsilon(round_off));
    }
  }
}

TEST_CASE("Flank tolerances belong to the gear of a pair that they are asked for", "[core][gear][iso1328]") {
  const GearPair pair = pair_cases::pair(18, 54, 30, 10.0, 120.0);
  const double d = 18 * 10.0 / std::cos(30 * units::deg);
  const FlankTolerances pinion = flank_tolerances(ToleranceData::of(pair, Member::Pinion), 6);
  CHECK(um(pinion.single_pitch) == Approx(std::sqrt(2.0) * (0.001 * d + 9.0)).epsilon(round_off));
  const FlankTolerances wheel = flank_tolerances(ToleranceData::of(pair, Member::Wheel), 6);
  CHECK(wheel.cumulative_pitch > pinion.cumulative_pitch);
  CHECK(wheel.profile_form == pinion.profile_form);  // depends on the module only
}

TEST_CASE("Tolerances are rounded as drawings state them", "[core][gear][iso1328]") {
  const auto rounded = [](double micrometres) { return um(rounded_tolerance(micrometres * units::um)); };
  CHECK(rounded(30.8) == Approx(31.0).epsilon(round_off));
  CHECK(rounded(10.2) == Approx(10.0).epsilon(round_off));
  CHECK(rounded(9.4) == Approx(9.5).epsilon(round_off));
  CHECK(rounded(9.2) == Approx(9.0).epsilon(round_off));
  CHECK(rounded(5.1) == Approx(5.0).epsilon(round_off));
  CHECK(rounded(4.96) == Approx(5.0).epsilon(round_off));
  CHECK(rounded(3.14) == Approx(3.1).epsilon(round_off));
}

TEST_CASE("Data outside the standard are refused by name", "[core][gear][iso1328]") {
  const auto field_refused = [](auto change, int tolerance_class = 6) -> std::string {
    ToleranceData gear = whole_roots;
    change(gear);
    try {
      flank_tolerances(gear, tolerance_class);
    } catch (const InvalidInput& problem) {
      return problem.field();
    }
    return "";
  };
  CHECK(field_refused([](ToleranceData&) {}) == "");
  CHECK(field_refused([](ToleranceData&) {}, 0) == "iso_1328_class");
  CHECK(field_refused([](ToleranceData&) {}, 12) == "iso_1328_class");
  CHECK(field_refused([](ToleranceData& g) { g.teeth = 4; }) == "teeth");
  CHECK(field_refused([](ToleranceData& g) { g.reference_diameter = 4.9; }) == "reference_diameter");
  CHECK(field_refused([](ToleranceData& g) { g.normal_module = 0.4; }) == "normal_module");
  CHECK(field_refused([](ToleranceData& g) { g.face_width = 1300.0; }) == "face_width");
  CHECK(field_refused([](ToleranceData& g) { g.helix_angle = 46 * units::deg; }) == "helix_angle");
  CHECK(field_refused([](ToleranceData& g) { g.helix_angle = 45 * units::deg; }) == "");
  CHECK(field_refused([](ToleranceData& g) { g.face_width = not_given; }) == "face_width");
}
