#include <catch2/catch.hpp>

#include "core/gear/flank_tolerances.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/tasks/sweep/sweep_design.hpp"
#include "studies/tasks/sweep/sweep_design.hpp"
#include "tests/studies/tasks/sweep/small_sweep.hpp"
#include "core/gear/gear_pair.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {
namespace {

using Catch::Contains;

Study sweep_keys(const std::string& settings, const std::string& more = "") { return parse_study(small::sweep(settings, more), "sweep.toml"); }

const SweepParameter& parameter(const Study& study, const std::string& path) {
  for (const SweepParameter& p : study.table<SweepTable>().parameters) {
    if (p.path == path) return p;
  }
  FAIL("no parameter " << path);
  return study.table<SweepTable>().parameters.front();
}

TEST_CASE("Distributions of a sweep are read in the unit of their key, or with their own", "[studies][sweep]") {
  const Study study = sweep_keys("samples = 100", R"(
"misalignment.crossing" = { normal = ["1 deg", "30 arcsec"] }
"wheel.error.pitch" = { values = [-3, "0.004 mm"] }
"wheel.modification.twist" = { grid = [-2, 2, 5] }
"wheel.error.twist" = { truncated_normal = [0, 2, -3, 3] }
)");
  CHECK(study.task == &find_task("sweep"));
  CHECK(study.table<SweepTable>().samples == 100);
  CHECK(study.table<SweepTable>().sampler == Sampler::Sobol);
  constexpr double round_off = 1e-13;
  CHECK(parameter(study, "load.torque").distribution.quantile(0.25) == 900.0);
  CHECK(parameter(study, "load.torque").unit == "N·m");
  const Distribution& crossing = parameter(study, "misalignment.crossing").distribution;  // arcmin
  CHECK(crossing.median() == Approx(60.0).epsilon(round_off));
  CHECK(crossing.quantile(0.975) - 60.0 == Approx(0.5 * 1.959963984540054).epsilon(1e-10));
  CHECK(parameter(study, "wheel.error.pitch").distribution == Distribution::values({-3.0, 4.0}));
  CHECK(parameter(study, "wheel.modification.twist").distribution == Distribution::grid(-2.0, 2.0, 5));
  CHECK(parameter(study, "wheel.error.twist").distribution == Distribution::truncated_normal(0.0, 2.0, -3.0, 3.0));
}

TEST_CASE("A tolerance class is that gear's tolerance, and of an error all three that it covers", "[studies][sweep]") {
  const Study study =
      sweep_keys("samples = 100", "\"pinion.error\" = { iso_1328_class = 6 }\n\"wheel.error.helix_slope\" = { iso_1328_class = 8 }\n");
  CHECK(study.table<SweepTable>().parameters.size() == 7);
  const GearPair pair = make_gear_pair(study.pair);
  const FlankTolerances pinion = flank_tolerances(ToleranceData::of(pair, Member::Pinion), 6);
  const FlankTolerances wheel = flank_tolerances(ToleranceData::of(pair, Member::Wheel), 8);
  CHECK(parameter(study, "pinion.error.helix_slope").distribution == Distribution::within_tolerance(pinion.helix_slope / units::um));
  CHECK(parameter(study, "pinion.error.profile_slope").distribution == Distribution::within_tolerance(pinion.profile_slope / units::um));
  const SweepParameter& pitch = parameter(study, "pinion.error.pitch");
  CHECK(pitch.pitch == PitchTolerance{study.pair.pinion.teeth, pinion.single_pitch, pinion.cumulative_pitch});
  CHECK(study.error.pinion.cumulative_pitch.empty());  // the nominal gear has equal pitches
  SweptCondition drawn = SweptCondition::of(study);
  set_swept(drawn, pitch, 12345.6);
  CHECK(drawn.scene.error.pinion.cumulative_pitch.size() == static_cast<std::size_t>(study.pair.pinion.teeth));
  CHECK(drawn.scene.error.wheel.cumulative_pitch.empty());
  SweptCondition same = SweptCondition::of(study);
  set_swept(same, pitch, 12345.0);
  CHECK(drawn.scene.error == same.scene.error);
  CHECK(parameter(study, "wheel.error.helix_slope").distribution == Distribution::within_tolerance(wheel.helix_slope / units::um));
}

TEST_CASE("In the nominal sample a parameter has its value, or its median where the study gives none", "[studies][sweep]") {
  const Study study = sweep_keys("samples = 100");
  CHECK(study.modification.pinion.lead_crowning == Approx(8.0 * units::um).epsilon(1e-14));  // round-off
  CHECK(study.torques == std::vector<double>{1014.868 * units::newton_metre});
  REQUIRE(study.scenes.size() == 1);
  CHECK(study.scenes[0].torques == study.torques);
}

TEST_CASE("A grid has as many samples as its levels make", "[studies][sweep]") {
  const std::string text = small::sweep("sampler = \"grid\"");
  const Study study = parse_study(text, "sweep.toml",
                                  {{"sweep.parameters",
                                    "{ load.torque = { values = [500, 1000] }, "
                                    "misalignment.mesh_misalignment = { grid = [-6, 6, 3] } }"}});
  CHECK(study.table<SweepTable>().samples == 6);
  const SweepDesign design(study.table<SweepTable>());
  CHECK(design.block_size() == 0);
  CHECK(design.values(0) == std::vector<double>{500.0, -6.0});
  CHECK(design.values(5) == std::vector<double>{1000.0, 6.0});
}

TEST_CASE("Parameters that a sweep cannot vary are refused by name", "[studies][sweep]") {
  using Row = std::tuple<std::string, std::string, std::string>;
  const auto [settings, more, said] = GENERATE(table<std::string, std::string, std::string>({
      Row{"", "\"pinion.teeth\" = { values = [17, 18] }\n", "sweep.parameters.pinion.teeth"},
      Row{"", "\"pair.helix_angle\" = { uniform = [29, 31] }\n", "a sweep cannot vary it"},
      Row{"", "\"misalignment.crosing\" = { normal = [0, 1] }\n", "did you mean crossing?"},
      Row{"", "\"misalignment.crossing\" = { normal = [0, -1] }\n", "deviation as a number above 0"},
      Row{"", "\"misalignment.crossing\" = { normal = [0] }\n", "{ normal = [mean, deviation] }"},
      Row{"", "\"misalignment.crossing\" = { gaussian = [0, 1] }\n", "{ uniform = [low, high] }"},
      Row{"", "\"misalignment.crossing\" = { uniform = [0, \"1 mm\"] }\n", "arcmin"},
      Row{"", "\"misalignment.crossing\" = { uniform = [0, 100] }\n", "-60 .. 60 arcmin"},
      Row{"", "\"misalignment.crossing\" = 3\n", "{ values = [...] }"},
      Row{"", "\"misalignment.crossing\" = { iso_1328_class = 6 }\n", "helix_slope, profile_slope and pitch"},
      Row{"", "\"pinion.error\" = { normal = [0, 1] }\n", "{ iso_1328_class = 1 .. 11 }"},
      Row{"", "\"pinion.error.pitch\" = { iso_1328_class = 12 }\n", "1 .. 11"},
      Row{"", "\"pinion.error\" = { iso_1328_class = 6 }\n\"pinion.error.pitch\" = { normal = [0, 1] }\n", "given twice"},
      Row{"", "\"wheel.modification.tip_relief.amount\" = { uniform = [0, 9] }\n", "wheel.modification.tip_relief.height above 0 mm"},
      Row{"", "\"wheel.modification.profile_crowning\" = { uniform = [0, 9] }\n\"wheel.modification.addendum_crowning\" = { uniform = [0, 9] }\n",
          "overlaps the parameter"},
      Row{"sampler = \"grid\"", "", "needs { grid = ... } or { values = ... }"},
      Row{"samples = 9", "", "at least 10 for Sobol indices"},
      Row{"seed = -1", "", "0 .. 2147483647"},
      Row{"samples = 30\n[[scenes]]\nname = \"a\"", "", "a sweep runs one working condition"},
  }));
  CAPTURE(more);
  CHECK_THROWS_WITH(sweep_keys(settings, more), Contains(said));
}

TEST_CASE("A compensation of the twist is swept where grinding twists", "[studies][sweep]") {
  const std::string compensation = "\"pinion.twist_compensation\" = { uniform = [0, 1] }\n";
  CHECK_NOTHROW(parse_study(small::sweep("", compensation), "s.toml", {{"pinion.process", "generating_grinding"}}));
  CHECK_THROWS_WITH(parse_study(small::sweep("", compensation), "s.toml"),
                    Contains("sweep.parameters.pinion.twist_compensation") && Contains("has no effect"));
}

TEST_CASE("A sweep without parameters, or with a list of torques, is refused", "[studies][sweep]") {
  CHECK_THROWS_WITH(parse_study(small::sweep(""), "s.toml", {{"sweep.parameters", "{}"}}), Contains("at least one parameter"));
  CHECK_THROWS_WITH(parse_study(small::sweep(""), "s.toml", {{"load.torque", "[1, 2]"}}), Contains("a sweep takes one torque"));
  CHECK_THROWS_WITH(parse_study(small::sweep(""), "s.toml", {{"load", "{ spectrum = [{ torque = 9, cycles = 1 }, { torque = 8, cycles = 1 }] }"}}),
                    Contains("sweep.parameters.load.torque") && Contains("allowed is this or load.spectrum"));
  CHECK_THROWS_WITH(parse_study(small::sweep(""), "s.toml",
                                {{"load", "{ spectrum = [{ torque = 9, cycles = 1 }, { torque = 8, cycles = 1 }] }"},
                                 {"sweep.parameters", "{ \"load.speed\" = { uniform = [500, 2000] } }"}}),
                    Contains("sweep.parameters.load.speed") && Contains("load.spectrum"));
}

}  // namespace
}  // namespace flankwright::studies
