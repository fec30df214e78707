#include "studies/study_file.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/units.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

constexpr double round_off = 1e-14;  // relative: one or two rounded factors

/// Thirteen lines that are a study; more tables may follow.
const std::string small_study = R"(title = "Small"
[pair]
normal_module = 4
helix_angle = 20

[pinion]
teeth = 20
face_width = 40

[wheel]
teeth = 30
face_width = 40
)";

Study read(const std::string& more = "", const std::vector<Override>& overrides = {}) {
  return parse_study(small_study + more, "small.toml", overrides);
}

std::vector<StudyProblem> problems_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse_study(text, "small.toml", overrides);
  } catch (const StudyErrors& errors) {
    return errors.problems();
  }
  return {};
}

/// The one problem that a study with these lines added has.
StudyProblem problem_of(const std::string& more, const std::vector<Override>& overrides = {}) {
  const std::vector<StudyProblem> problems = problems_of(small_study + more, overrides);
  CAPTURE(more);
  REQUIRE(problems.size() == 1);
  return problems.front();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

const std::string optimise = R"([load]
torque = 100
[optimise]
)";

}  // namespace

TEST_CASE("Bare numbers have the documented units and everything inside is mm, N mm, rad, MPa",
          "[studies][study-file]") {
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
  CHECK(study.pair.helix_angle == Approx(std::acos(-1.0) / 9.0).epsilon(round_off));
  CHECK(study.pinion_modification.lead_crowning == Approx(0.008).epsilon(round_off));
  CHECK(study.pinion_modification.tip_relief.amount == Approx(0.010).epsilon(round_off));
  CHECK(study.pinion_modification.tip_relief.height == 2.5);
  CHECK(study.pinion_modification.tip_relief.shape == ReliefShape::Parabolic);
  CHECK(study.wheel_modification.tip_relief.amount == 0.0);
  CHECK(study.wheel_error.helix_slope == Approx(-0.004).epsilon(round_off));
  CHECK(study.misalignment.crossing == Approx(3.0 * std::acos(-1.0) / 10800.0).epsilon(round_off));
  CHECK(study.misalignment.centre_distance == 0.05);
  CHECK(study.misalignment.mesh_misalignment == Approx(0.012).epsilon(round_off));
  CHECK(study.torques == std::vector<double>{1e5, 1e6});
}

TEST_CASE("A study without a key has the defaults of the data types", "[studies][study-file]") {
  const Study study = read();
  const PairData pair;
  CHECK(study.task == Task::Analyse);
  CHECK(study.pair.pressure_angle == pair.pressure_angle);
  CHECK(std::isnan(study.pair.centre_distance));
  CHECK(std::isnan(study.pair.pinion.tip_diameter));
  CHECK(study.pair.pinion.rack.root_radius == RackProfile{}.root_radius);
  CHECK(study.pair.wheel.rack.dedendum == RackProfile{}.dedendum);
  CHECK(study.wheel_material.youngs_modulus == Material{}.youngs_modulus);
  CHECK(study.torques == std::vector<double>{0.0});
  CHECK(study.cycle.positions == Cycle{}.positions);
  CHECK(study.cycle.phases.empty());
  CHECK(study.fidelity.compliance == ComplianceModel::ThinSlice);
  CHECK(study.fidelity.automatic_effects);
  CHECK(study.fidelity.quadrature.intervals == Quadrature{}.intervals);
  REQUIRE(study.scenes.size() == 1);
  CHECK(study.scenes.front().name == Scene{}.name);
  CHECK(study.optimise.objective.size() == 1);
  CHECK(std::isinf(study.optimise.max_seconds));
  CHECK(parse_study(replaced(small_study, "title = \"Small\"\n", ""), "dir/pump.toml").title == "pump");
}

TEST_CASE("A diametral pitch stands for the module 25.4 mm / P", "[studies][study-file]") {
  const std::string text = replaced(small_study, "normal_module = 4", "normal_diametral_pitch = 5");
  CHECK(parse_study(text, "inch.toml").pair.normal_module == Approx(5.08).epsilon(round_off));
  const auto both =
      problems_of(replaced(small_study, "normal_module = 4", "normal_module = 5.08\nnormal_diametral_pitch = 5"));
  REQUIRE(both.size() == 1);
  CHECK(both.front().key == "pair.normal_diametral_pitch");
  CHECK(both.front().line == 4);
  // From the command line the one replaces the other.
  CHECK(read("", {{"pair.normal_diametral_pitch", "5"}}).pair.normal_module == Approx(5.08).epsilon(round_off));
}

TEST_CASE("A gear's own material overrides the common one", "[studies][study-file]") {
  const Study study = read("[wheel.material]\nyoungs_modulus = \"110 GPa\"\n[material]\nyoungs_modulus = 200000\n");
  CHECK(study.pinion_material.youngs_modulus == 200000.0);
  CHECK(study.wheel_material.youngs_modulus == Approx(110000.0).epsilon(round_off));
  CHECK(study.wheel_material.poissons_ratio == 0.3);
}

TEST_CASE("Profile crowning sets both halves, and giving a half as well is refused", "[studies][study-file]") {
  const Study study = read("[wheel.modification]\nprofile_crowning = 6\n");
  CHECK(study.wheel_modification.addendum_crowning == Approx(0.006).epsilon(round_off));
  CHECK(study.wheel_modification.dedendum_crowning == Approx(0.006).epsilon(round_off));
  CHECK(read("[wheel.modification]\naddendum_crowning = 5\n").wheel_modification.dedendum_crowning == 0.0);
  CHECK(problem_of("[wheel.modification]\nprofile_crowning = 6\ndedendum_crowning = 2\n").key ==
        "wheel.modification.dedendum_crowning");
}

TEST_CASE("A pitch error is a step for every tooth, or a list with one entry a tooth", "[studies][study-file]") {
  CHECK(read("[pinion.error]\npitch = 3\n").pinion_error.pitch_step == Approx(0.003).epsilon(round_off));
  std::string list = "[0";
  for (int tooth = 1; tooth < 20; ++tooth) list += ", " + std::to_string(tooth % 3);
  const Study study = read("[pinion.error]\npitch = " + list + "]\n");
  CHECK(study.pinion_error.pitch_step == 0.0);
  CHECK(study.pinion_error.cumulative_pitch.size() == 20);
  CHECK(study.pinion_error.cumulative_pitch[5] == Approx(0.002).epsilon(round_off));
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
  CHECK(hot.misalignment.mesh_misalignment == Approx(0.012).epsilon(round_off));
  CHECK(hot.torques == std::vector<double>{3e5});
  CHECK(hot.pinion_error.helix_slope == Approx(0.007).epsilon(round_off));
  CHECK(study.pinion_error.helix_slope == 0.0);

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
  const OptimiseTable& table = study.optimise;
  CHECK(study.task == Task::Optimise);
  REQUIRE(table.objective.size() == 2);
  CHECK(table.objective[1].output == Output::TeHarmonic);
  CHECK(table.objective[1].harmonic == 2);
  CHECK(table.objective[1].weight == 0.5);
  CHECK(table.over == Aggregate::MeanPlusTwoSigma);
  CHECK(table.max_seconds == 120.0);
  REQUIRE(table.variables.size() == 3);
  CHECK(table.variables[0].upper == Approx(0.040).epsilon(round_off));
  CHECK(table.variables[1].member == Member::Wheel);
  CHECK(table.variables[1].lower == Approx(0.005).epsilon(round_off));
  CHECK(table.variables[1].upper == Approx(0.030).epsilon(round_off));
  CHECK(table.variables[2].parameter == ModificationParameter::TipReliefHeight);
  CHECK(table.variables[2].upper == 2.0);
  REQUIRE(table.constraints.size() == 2);
  CHECK(table.constraints[0].maximum == Approx(1200.0).epsilon(round_off));
  CHECK(table.constraints[1].maximum == Approx(0.0015).epsilon(round_off));
}

TEST_CASE("An optimisation that cannot be run is refused with what to do", "[studies][study-file]") {
  using Row = std::tuple<std::string, std::string, std::string>;
  const auto [more, key, advice] = GENERATE(table<std::string, std::string, std::string>({
      Row{"solver = \"snopt\"\n", "optimise.solver", "ipopt"},
      Row{"solver = \"nlopt:lbfgs\"\n[optimise.variables]\npinion.modification.twist = [0, 1]\n[optimise.constraints]\n"
          "load_factor = { max = 2 }\n",
          "optimise.solver", "no constraints"},
      Row{"objective = \"peak_root_stress\"\n", "optimise.objective", "not in this version"},
      Row{"objective = \"te_harmonic_11\"\n", "optimise.objective", "te_harmonic_1"},
      Row{"[optimise.variables]\n", "optimise.variables", "at least one variable"},
      Row{"[optimise.variables]\npinion.modification.lead_crownin = [0, 1]\n",
          "optimise.variables.pinion.modification.lead_crownin", "lead_crowning"},
      Row{"[optimise.variables]\npinion.modification.lead_crowning = [3, 3]\n",
          "optimise.variables.pinion.modification.lead_crowning", "low below high"},
      Row{"[optimise.variables]\npinion.teeth = [5, 10]\n", "optimise.variables.pinion.teeth", "modification"},
      Row{"[optimise.variables]\npinion.modification.profile_crowning = [0, 3]\n"
          "pinion.modification.addendum_crowning = [0, 3]\n",
          "optimise.variables.pinion.modification.addendum_crowning", "overlaps"},
      Row{"[optimise.variables]\npinion.modification.tip_relief.amount = [0, 3]\n",
          "pinion.modification.tip_relief.height", "set pinion.modification.tip_relief.height"},
      Row{"[optimise.variables]\nwheel.modification.end_relief.amount = [0, 3]\n",
          "wheel.modification.end_relief.length", "set wheel.modification.end_relief.length"},
      Row{"[optimise.variables]\npinion.modification.tip_relief.height = [1, 3]\n",
          "optimise.variables.pinion.modification.tip_relief.height", "no effect"},
  }));
  // These two are judged when the task is to optimise.
  const bool is_about_task = key == "optimise.variables" || advice == "no constraints";
  const StudyProblem problem = problem_of(
      optimise + more, is_about_task ? std::vector<Override>{{"task", "optimise"}} : std::vector<Override>{});
  CHECK(problem.key == key);
  CHECK_THAT(problem.allowed, Catch::Contains(advice));
}

TEST_CASE("A relief with an amount needs its height", "[studies][study-file]") {
  const StudyProblem problem = problem_of("[pinion.modification]\nroot_relief = { amount = 8 }\n");
  CHECK(problem.key == "pinion.modification.root_relief.height");
  CHECK(problem.line == 14);
  CHECK_NOTHROW(read("[pinion.modification]\nroot_relief = { amount = 0, height = 0 }\n"));
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
  CHECK(study.expect[1].within_relative == Approx(0.02).epsilon(round_off));
  CHECK(study.expect[2].key == "unloaded.mesh.peak_to_peak_arcsec");
  CHECK(study.expect[2].maximum == 5.0);

  const std::string entry =
      GENERATE("{}", "{ value = 1 }", "{ within = 1 }", "{ value = 1, max = 2 }", "{ min = 2, max = 1 }",
               "{ value = 1, within = \"2\" }", "{ value = 0, within = \"2 %\" }", "{ value = 1, within = -1 }",
               "{ maximum = 1 }", "3", "{ max = nan }");
  CHECK_THAT(problem_of("[expect]\n\"a.b\" = " + entry + "\n").key, Catch::StartsWith("expect.a.b"));
}

TEST_CASE("A value outside its range is refused at its line with what is allowed", "[studies][study-file]") {
  using Row = std::tuple<std::string, std::string>;
  const auto [more, allowed] = GENERATE(table<std::string, std::string>({
      Row{"[load]\ntorque = -5\n", "working_flank = \"left\""},
      Row{"[load]\ntorque = []\n", "not empty"},
      Row{"[load]\ntorque = inf\n", "N·m"},
      Row{"[load]\ntorque = true\n", "N·m"},
      Row{"[misalignment]\ncrossing = \"90 arcmin\"\n", "-60 .. 60 arcmin"},
      Row{"[misalignment]\ncrossing = \"3 mm\"\n", "arcmin"},
      Row{"[pinion.modification]\nlead_crowning = 2000\n", "-1000 .. 1000 um"},
      Row{"[pinion.modification]\nlead_crowning = nan\n", "-1000 .. 1000 um"},
      Row{"[material]\npoissons_ratio = 0.5\n", "below 0.5"},
      Row{"[material]\nyoungs_modulus = 0\n", "above 0"},
      Row{"[cycle]\npositions = 4097\n", "4096"},
      Row{"[cycle]\npositions = 8.0\n", "integer"},
      Row{"[fidelity]\ncompliance = \"fe\"\n", "not in this version"},
      Row{"[fidelity]\ngap = \"whole_surface\"\n", "not in this version"},
      Row{"[fidelity]\neffects = [\"bendig\"]\n", "bending"},
      Row{"[fidelity]\nquadrature = 3\n", "table"},
      Row{"[wheel]\n", "redefine"},
      Row{"[sweep]\nsamples = 3\n", "not in this version"},
      Row{"[pinion.modification]\ngrid = \"flank.csv\"\n", "not in this version"},
      Row{"[pinion.modification]\nparabolic_te = 0.1\n", "not in this version"},
  }));
  const StudyProblem problem = problem_of(more);
  CHECK(problem.line >= 13);
  CHECK_THAT(problem.allowed, Catch::Contains(allowed));
}

TEST_CASE("The bounds of a range belong to it in every unit", "[studies][study-file]") {
  for (const std::string angle :
       {"45", "\"45 deg\"", "\"2700 arcmin\"", "\"162000 arcsec\"", "\"0.78539816339744830962 rad\""}) {
    CAPTURE(angle);
    CHECK(read("", {{"pair.helix_angle", angle}}).pair.helix_angle == 45 * units::deg);
  }
  CHECK(problem_of("", {{"pair.helix_angle", "45.001"}}).key == "pair.helix_angle");
  CHECK_THAT(problem_of("", {{"pair.helix_angle", "-20"}}).allowed, Catch::Contains("hand"));
}

TEST_CASE("What a later version brings may be written with its default", "[studies][study-file]") {
  CHECK_NOTHROW(read("[pinion.modification]\nparabolic_te = 0\n", {{"wheel.generation", "rack"}}));
}

TEST_CASE("The wheel's hand may be said and must be the opposite of the pinion's", "[studies][study-file]") {
  CHECK(read("hand = \"left\"\n").pair.pinion_hand == Hand::Right);
  CHECK(read("hand = \"right\"\n", {{"pinion.hand", "left"}}).pair.pinion_hand == Hand::Left);
  CHECK(problem_of("hand = \"right\"\n").key == "wheel.hand");
}

TEST_CASE("All problems come at once, in the order of the lines, as file:line:column", "[studies][study-file]") {
  const std::string text = R"(task = "sweep"
[pair]
normal_module = 0
helix_angel = 30
[pinion]
  teeth = 2
[wheel]
teeth = "many"
)";
  const std::vector<StudyProblem> problems = problems_of(text, {{"load.torque", "3 parsec"}});
  REQUIRE(problems.size() == 8);
  const auto by_line = [](const StudyProblem& a, const StudyProblem& b) { return a.line < b.line; };
  CHECK(std::is_sorted(problems.begin(), problems.end() - 1, by_line));
  CHECK(problems[2].key == "pair.helix_angel");
  CHECK_THAT(problems[2].allowed, Catch::Contains("did you mean helix_angle?"));
  CHECK(problems.back().file == "--set");
  CHECK(problems.back().key == "load.torque");
  CHECK(std::ranges::count_if(problems, [](const auto& p) { return p.key.ends_with("face_width"); }) == 2);
  CHECK(to_string(problems[4]) == "small.toml:6:3: pinion.teeth = 2: allowed is an integer 5 .. 1000");
  CHECK_THROWS_WITH(parse_study(text, "small.toml"),
                    Catch::Contains("small.toml:8:1: wheel.teeth = \"many\": allowed"));
}

TEST_CASE("A misspelt key names the key that was meant", "[studies][study-file]") {
  using Row = std::tuple<std::string, std::string>;
  const auto [more, meant] = GENERATE(table<std::string, std::string>({
      Row{"[pinion.modification]\nled_crowning = 3\n", "lead_crowning"},
      Row{"[misalignment]\ncenter_distance = 0.1\n", "centre_distance"},
      Row{"[pinon]\nx = 1\n", "pinion"},
      Row{"[optimize]\nx = 1\n", "optimise"},
      Row{"[fidelity]\npositions = 3\n", "cycle.positions"},
      Row{"[[scenes]]\nmisalignment.crosing = 3\n", "crossing"},
  }));
  CHECK_THAT(problem_of(more).allowed, Catch::Contains("did you mean " + meant + "?"));
}

TEST_CASE("Geometry that cannot be built is reported where its key stands", "[studies][study-file]") {
  const std::vector<StudyProblem> problems =
      problems_of(replaced(small_study, "helix_angle = 20", "helix_angle = 20\ncentre_distance = 50"));
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().key == "pair.centre_distance");
  CHECK(problems.front().line == 5);
}

TEST_CASE("What is not TOML is one problem with line and column and no key", "[studies][study-file]") {
  const std::vector<StudyProblem> problems = problems_of("title = \"x\"\n[pair\n");
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().line == 2);
  CHECK(problems.front().column > 1);
  CHECK(problems.front().key.empty());
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
  REQUIRE(study.optimise.variables.size() == 1);
  CHECK(study.optimise.variables.front().upper == Approx(0.0121).epsilon(round_off));
  CHECK(study.scenes.front().torques.front() == Approx(120 * 4.4482216152605 * 25.4).epsilon(round_off));

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
