#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "core/gear/tooth_form.hpp"
#include "core/base/units.hpp"
#include "tests/studies/study_texts.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

using study_texts::problem_of;
using study_texts::problems_of;
using study_texts::read;
using study_texts::replaced;
using study_texts::small_study;

namespace {

constexpr double file_round_off = 1e-14;  // relative: one or two rounded factors

}  // namespace

TEST_CASE("Bare numbers have the documented units and everything inside is mm, N mm, rad, MPa", "[studies][study-file]") {
  const Study study = read(R"([pinion.modification]
lead_crowning = 8
tip_relief = { amount = 10, height = 2.5, shape = "parabolic" }
[wheel.error]
helix_slope = -4
[misalignment]
crossing = 3
centre_distance = 0.05
mesh_misalignment = "0.012 mm"
[load]
torque = [100, "1 kN·m"]
)");
  CHECK(study.pair.normal_module == 4.0);
  CHECK(study.pair.helix_angle == Approx(std::acos(-1.0) / 9.0).epsilon(file_round_off));
  CHECK(study.modification.pinion.lead_crowning == Approx(0.008).epsilon(file_round_off));
  CHECK(study.modification.pinion.tip_relief.amount == Approx(0.010).epsilon(file_round_off));
  CHECK(study.modification.pinion.tip_relief.height == 2.5);
  CHECK(study.modification.pinion.tip_relief.shape == ReliefShape::Parabolic);
  CHECK(study.modification.wheel.tip_relief.amount == 0.0);
  CHECK(study.error.wheel.helix_slope == Approx(-0.004).epsilon(file_round_off));
  CHECK(study.misalignment.crossing == Approx(3.0 * std::acos(-1.0) / 10800.0).epsilon(file_round_off));
  CHECK(study.misalignment.centre_distance == 0.05);
  CHECK(study.misalignment.mesh_misalignment == Approx(0.012).epsilon(file_round_off));
  CHECK(study.torques == std::vector<double>{1e5, 1e6});
}

TEST_CASE("A study without a key has the defaults of the data types", "[studies][study-file]") {
  const Study study = read();
  const PairData pair;
  CHECK(study.task == &find_task("analyse"));
  CHECK(study.pair.pressure_angle == pair.pressure_angle);
  CHECK(std::isnan(study.pair.centre_distance));
  CHECK(std::isnan(study.pair.pinion.tip_diameter));
  CHECK(study.pair.pinion.rack.root_radius == RackProfile{}.root_radius);
  CHECK(study.pair.wheel.rack.dedendum == RackProfile{}.dedendum);
  CHECK(study.material.wheel.youngs_modulus == Material{}.youngs_modulus);
  CHECK(study.torques == std::vector<double>{0.0});
  CHECK(study.cycle.positions == Cycle{}.positions);
  CHECK(study.cycle.phases.empty());
  CHECK(study.fidelity.compliance == ComplianceModel::Fitted);
  CHECK(study.fidelity.automatic_effects);
  CHECK(study.fidelity.quadrature.intervals == Fidelity{}.quadrature.intervals);
  REQUIRE(study.scenes.size() == 1);
  CHECK(study.scenes.front().name == Scene{}.name);
  CHECK(study.table<OptimiseTable>().objective.size() == 1);
  CHECK(std::isinf(study.table<OptimiseTable>().solver.max_seconds));
  CHECK(parse_study(replaced(small_study, "title = \"Small\"\n", ""), "dir/pump.toml").title == "pump");
}

TEST_CASE("A rack without a rounding has the usual one, or the full rounding of a tool that is too narrow for it", "[studies][file]") {
  const auto rounding = [](const std::vector<Override>& overrides) { return study_texts::read("", overrides).pair.pinion.rack.root_radius; };
  CHECK(rounding({}) == RackProfile{}.root_radius);
  CHECK(rounding({{"pair.pressure_angle", "25"}}) == full_tip_rounding(1.25, 25 * units::deg));
  CHECK(rounding({{"pinion.rack.dedendum", "1.6"}}) == full_tip_rounding(1.6, 20 * units::deg));
  CHECK(rounding({{"pair.pressure_angle", "25"}, {"pinion.rack.root_radius", "0.2"}}) == 0.2);
  // One that is given is held against the tool.
  CHECK(study_texts::problem_of("", {{"pair.pressure_angle", "25"}, {"pinion.rack.root_radius", "0.39"}}).key == "pinion.rack.root_radius");
}

TEST_CASE("A diametral pitch P is the module 25.4 mm / P", "[studies][study-file]") {
  const std::string text = replaced(small_study, "normal_module = 4", "normal_diametral_pitch = 5");
  CHECK(parse_study(text, "inch.toml").pair.normal_module == Approx(5.08).epsilon(file_round_off));
  const auto both = problems_of(replaced(small_study, "normal_module = 4", "normal_module = 5.08\nnormal_diametral_pitch = 5"));
  REQUIRE(both.size() == 1);
  CHECK(both.front().key == "pair.normal_diametral_pitch");
  CHECK(both.front().line == 4);
  // From the command line the one replaces the other.
  CHECK(read("", {{"pair.normal_diametral_pitch", "5"}}).pair.normal_module == Approx(5.08).epsilon(file_round_off));
}

TEST_CASE("A gear's own material overrides the common one", "[studies][study-file]") {
  const Study study = read("[wheel.material]\nyoungs_modulus = \"110 GPa\"\n[material]\nyoungs_modulus = 200000\n");
  CHECK(study.material.pinion.youngs_modulus == 200000.0);
  CHECK(study.material.wheel.youngs_modulus == Approx(110000.0).epsilon(file_round_off));
  CHECK(study.material.wheel.poissons_ratio == 0.3);
}

TEST_CASE("Profile crowning sets both halves, and giving a half as well is refused", "[studies][study-file]") {
  const Study study = read("[wheel.modification]\nprofile_crowning = 6\n");
  CHECK(study.modification.wheel.addendum_crowning == Approx(0.006).epsilon(file_round_off));
  CHECK(study.modification.wheel.dedendum_crowning == Approx(0.006).epsilon(file_round_off));
  CHECK(read("[wheel.modification]\naddendum_crowning = 5\n").modification.wheel.dedendum_crowning == 0.0);
  CHECK(problem_of("[wheel.modification]\nprofile_crowning = 6\ndedendum_crowning = 2\n").key == "wheel.modification.dedendum_crowning");
}

TEST_CASE("A pitch error is a step for every tooth, or a list with one entry a tooth", "[studies][study-file]") {
  CHECK(read("[pinion.error]\npitch = 3\n").error.pinion.pitch_step == Approx(0.003).epsilon(file_round_off));
  std::string list = "[0";
  for (int tooth = 1; tooth < 20; ++tooth) list += ", " + std::to_string(tooth % 3);
  const Study study = read("[pinion.error]\npitch = " + list + "]\n");
  CHECK(study.error.pinion.pitch_step == 0.0);
  CHECK(study.error.pinion.cumulative_pitch.size() == 20);
  CHECK(study.error.pinion.cumulative_pitch[5] == Approx(0.002).epsilon(file_round_off));
  const StudyProblem problem = problem_of("[wheel.error]\npitch = [1, 2, 3]\n");
  CHECK(problem.line == 14);
  CHECK_THAT(problem.allowed, Catch::Contains("30"));
  CHECK(problem_of("[[scenes]]\nwheel.error.pitch = [1, 2]\n").key == "scenes.0.wheel.error.pitch");
}

TEST_CASE("A scene is the base with what it overrides", "[studies][study-file]") {
  const Study study = read(R"([misalignment]
crossing = 1
mesh_misalignment = 5
[load]
torque = 100
[[scenes]]
[[scenes]]
name = "hot"
weight = 2
misalignment.mesh_misalignment = 12
load.torque = ["300 N m"]
pinion.error.helix_slope = 7
)");
  REQUIRE(study.scenes.size() == 2);
  const Scene& cold = study.scenes[0];
  const Scene& hot = study.scenes[1];
  CHECK(cold.name == "scene 1");
  CHECK(cold.misalignment.mesh_misalignment == study.misalignment.mesh_misalignment);
  CHECK(cold.torques == study.torques);
  CHECK(hot.name == "hot");
  CHECK(hot.weight == 2.0);
  CHECK(hot.misalignment.crossing == study.misalignment.crossing);
  CHECK(hot.misalignment.mesh_misalignment == Approx(0.012).epsilon(file_round_off));
  CHECK(hot.torques == std::vector<double>{3e5});
  CHECK(hot.error.pinion.helix_slope == Approx(0.007).epsilon(file_round_off));
  CHECK(study.error.pinion.helix_slope == 0.0);

  const StudyProblem problem = problem_of("[[scenes]]\npinion.teeth = 21\n");
  CHECK(problem.line == 14);
  CHECK_THAT(problem.allowed, Catch::Contains("load.torque"));
  CHECK(problem_of("[[scenes]]\nname = \"a\"\n[[scenes]]\nname = \"a\"\n").line == 16);
}

TEST_CASE("Variables, objective and constraints are read in their own units", "[studies][study-file]") {
  const Study study = read(
      "[load]\ntorque = 100\n"
      R"([optimise]
objective = { te_harmonic_1 = 1, te_harmonic_2 = 0.5 }
over = "mean+2sigma"
solver = "nlopt:slsqp"
max_seconds = "2 min"
[optimise.variables]
"pinion.modification.lead_crowning" = [0, 40]
wheel.modification.tip_relief.amount = ["5 um", "0.03 mm"]
wheel.modification.tip_relief.height = [0.5, 2]
[optimise.constraints]
"te_peak_to_peak" = { max = 1.5 }
"peak_contact_stress" = { max = "1.2 GPa" }
)",
      {{"task", "optimise"}});
  const OptimiseTable& table = study.table<OptimiseTable>();
  CHECK(study.task == &find_task("optimise"));
  REQUIRE(table.objective.size() == 2);
  CHECK(table.objective[1].output == Output::TeHarmonic);
  CHECK(table.objective[1].harmonic == 2);
  CHECK(table.objective[1].weight == 0.5);
  CHECK(table.over == Aggregate::MeanPlusSigmas);
  CHECK(table.solver.max_seconds == 120.0);
  REQUIRE(table.variables.size() == 3);
  CHECK(table.variables[0].upper == Approx(0.040).epsilon(file_round_off));
  CHECK(table.variables[1].member == Member::Wheel);
  CHECK(table.variables[1].lower == Approx(0.005).epsilon(file_round_off));
  CHECK(table.variables[1].upper == Approx(0.030).epsilon(file_round_off));
  CHECK(table.variables[2].parameter == parameter_of("tip_relief.height"));
  CHECK(table.variables[2].upper == 2.0);
  REQUIRE(table.constraints.size() == 2);
  CHECK(table.constraints[0].maximum == Approx(1200.0).epsilon(file_round_off));
  CHECK(table.constraints[1].maximum == Approx(0.0015).epsilon(file_round_off));
}

TEST_CASE("Expectations may be a text or a truth value", "[studies][study-file]") {
  const Study study = read("[expect]\n\"a.b\" = { is = \"surface\" }\n\"a.c\" = { is = true }\n");
  REQUIRE(study.expect.size() == 2);
  CHECK(study.expect[0].is == "surface");
  CHECK(study.expect[1].is == "true");
  const std::string entry = GENERATE("{ is = 3 }", "{ is = \"\" }", "{ is = \"a\", max = 2 }", "{ is = [] }");
  CHECK(problem_of("[expect]\n\"a.b\" = " + entry + "\n").key == "expect.a.b");
}

TEST_CASE("Expectations have a value with a tolerance, or bounds", "[studies][study-file]") {
  const Study study = read(R"([expect]
"loaded.summary.te_peak_to_peak_um" = { value = 0.84, within = "2 %" }
"loaded.0.summary.te_mean_um" = { value = -3, within = 0.1 }
unloaded.mesh.peak_to_peak_arcsec = { max = 5 }
)");
  REQUIRE(study.expect.size() == 3);
  CHECK(study.expect[0].key == "loaded.0.summary.te_mean_um");
  CHECK(study.expect[0].within_absolute == 0.1);
  CHECK(std::isnan(study.expect[0].within_relative));
  CHECK(study.expect[1].value == 0.84);
  CHECK(study.expect[1].within_relative == Approx(0.02).epsilon(file_round_off));
  CHECK(study.expect[2].key == "unloaded.mesh.peak_to_peak_arcsec");
  CHECK(study.expect[2].maximum == 5.0);

  const std::string entry =
      GENERATE("{}", "{ value = 1 }", "{ within = 1 }", "{ value = 1, max = 2 }", "{ min = 2, max = 1 }", "{ value = 1, within = \"2\" }",
               "{ value = 0, within = \"2 %\" }", "{ value = 1, within = -1 }", "{ maximum = 1 }", "3", "{ max = nan }");
  CHECK_THAT(problem_of("[expect]\n\"a.b\" = " + entry + "\n").key, Catch::StartsWith("expect.a.b"));
}

TEST_CASE("The bounds of a range belong to it in every unit", "[studies][study-file]") {
  for (const std::string angle : {"45", "\"45 deg\"", "\"2700 arcmin\"", "\"162000 arcsec\"", "\"0.78539816339744830962 rad\""}) {
    CAPTURE(angle);
    CHECK(read("", {{"pair.helix_angle", angle}}).pair.helix_angle == 45 * units::deg);
  }
  CHECK(problem_of("", {{"pair.helix_angle", "45.001"}}).key == "pair.helix_angle");
  CHECK_THAT(problem_of("", {{"pair.helix_angle", "-20"}}).allowed, Catch::Contains("hand"));
}

TEST_CASE("The wheel's hand may be said and must be the opposite of the pinion's", "[studies][study-file]") {
  CHECK(read("hand = \"left\"\n").pair.pinion_hand == Hand::Right);
  CHECK(read("hand = \"right\"\n", {{"pinion.hand", "left"}}).pair.pinion_hand == Hand::Left);
  CHECK(problem_of("hand = \"right\"\n").key == "wheel.hand");
}

TEST_CASE("The command line replaces, adds and is remembered with what the file gave", "[studies][study-file]") {
  const std::string more =
      "[optimise.variables]\n\"pinion.modification.lead_crowning\" = [0, 40]  # um\n"
      "[[scenes]]\nname = \"a\"\n";
  const Study study = read(more, {{"pinion.teeth", "21"},
                                  {"misalignment.crossing", "3 arcmin"},
                                  {"optimise.variables.pinion.modification.lead_crowning", "[0, 12.1]"},
                                  {"scenes.0.load.torque", "120 lbf in"}});
  CHECK(study.pair.pinion.teeth == 21);
  CHECK(study.misalignment.crossing == 3 * units::arcmin);
  REQUIRE(study.table<OptimiseTable>().variables.size() == 1);
  CHECK(study.table<OptimiseTable>().variables.front().upper == Approx(0.0121).epsilon(file_round_off));
  CHECK(study.scenes.front().torques.front() == Approx(120 * 4.4482216152605 * 25.4).epsilon(file_round_off));

  const auto given = [&study](const std::string& key) -> std::string {
    const auto found = std::ranges::find_if(study.given, [&](const GivenValue& g) { return g.key == key; });
    return found == study.given.end() ? "not there" : found->value;
  };
  CHECK(given("title") == "\"Small\"");
  CHECK(given("wheel.teeth") == "30");
  CHECK(given("pinion.teeth") == "21");
  CHECK(given("optimise.variables.pinion.modification.lead_crowning") == "[0, 12.1]");
  CHECK(given("scenes.0.name") == "\"a\"");
  CHECK(given("pair.pressure_angle") == "not there");
}

TEST_CASE("A file is read like its text, and one that cannot be read is said so", "[studies][study-file]") {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "flankwright_study_file_test.toml";
  std::ofstream(path) << small_study;
  const Study study = read_study(path.string());
  std::filesystem::remove(path);
  CHECK(study.file == path.string());
  CHECK(study.pair.wheel.teeth == 30);
  try {
    read_study(path.string());
    FAIL("the file is gone");
  } catch (const StudyErrors& errors) {
    REQUIRE(errors.problems().size() == 1);
    CHECK(errors.problems().front().line == 0);
    CHECK(errors.problems().front().file == path.string());
  }
}

}  // namespace flankwright::studies
