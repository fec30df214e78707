#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "tests/studies/study_texts.hpp"

namespace flankwright::studies {

using study_texts::problem_of;
using study_texts::problems_of;
using study_texts::read;
using study_texts::replaced;
using study_texts::small_study;

namespace {

const std::string optimise = R"([load]
torque = 100
[optimise]
)";

}  // namespace

TEST_CASE("A title, a name of a scene or a path is one line without control characters", "[studies][study-file]") {
  const std::string allowed = "a text without control characters or line ends";
  for (const char* text : {"\\u001B[31m", "a\\u0000b", "two\\nlines", "\\u007F", "\\u009B2J"}) {
    CAPTURE(text);
    CHECK_THAT(problem_of("", {{"title", "\"" + std::string(text) + "\""}}).allowed, Catch::Contains(allowed));
    CHECK_THAT(problem_of("[[scenes]]\nname = \"" + std::string(text) + "\"\n").allowed, Catch::Contains(allowed));
  }
  CHECK(read("", {{"title", "\"Getriebe \u00e4\u00b5\""}}).title == "Getriebe \u00e4\u00b5");
}

TEST_CASE("An optimisation that cannot be run is refused with what to do", "[studies][study-file]") {
  using Row = std::tuple<std::string, std::string, std::string>;
  const auto [more, key, advice] = GENERATE(table<std::string, std::string, std::string>({
      Row{"solver = \"snopt\"\n", "optimise.solver", "ipopt"},
      Row{"finisher = \"slsqp\"\n", "optimise.finisher", "\"nlopt:slsqp\""},
      Row{"finisher = \"nlopt:cobyla\"\n", "optimise.finisher", "\"none\""},
      Row{"solver = \"nlopt:crs2_lm\"\nfinisher = \"none\"\n[optimise.variables]\npinion.modification.twist = [0, 1]\n", "optimise.finisher",
          "gradients and constraints only"},
      Row{"solver = \"nlopt:lbfgs\"\n[optimise.variables]\npinion.modification.twist = [0, 1]\n[optimise.constraints]\n"
          "load_factor = { max = 2 }\n",
          "optimise.solver", "no constraints"},
      Row{"objective = \"peak_root_stres\"\n", "optimise.objective", "did you mean peak_root_stress"},
      Row{"objective = \"te_harmonic_11\"\n", "optimise.objective", "te_harmonic_1"},
      Row{"[optimise.variables]\n", "optimise.variables", "at least one variable"},
      Row{"[optimise.variables]\npinion.modification.lead_crownin = [0, 1]\n", "optimise.variables.pinion.modification.lead_crownin",
          "lead_crowning"},
      Row{"[optimise.variables]\npinion.modification.lead_crowning = [3, 3]\n", "optimise.variables.pinion.modification.lead_crowning",
          "low below high"},
      Row{"[optimise.variables]\npinion.teeth = [5, 10]\n", "optimise.variables.pinion.teeth", "modification"},
      Row{"[optimise.variables]\npinion.modification.profile_crowning = [0, 3]\n"
          "pinion.modification.addendum_crowning = [0, 3]\n",
          "optimise.variables.pinion.modification.addendum_crowning", "overlaps"},
      Row{"[optimise.variables]\npinion.modification.tip_relief.amount = [0, 3]\n", "pinion.modification.tip_relief.height",
          "set pinion.modification.tip_relief.height"},
      Row{"[optimise.variables]\nwheel.modification.end_relief.amount = [0, 3]\n", "wheel.modification.end_relief.length",
          "set wheel.modification.end_relief.length"},
      Row{"[optimise.variables]\npinion.modification.tip_relief.height = [1, 3]\n", "optimise.variables.pinion.modification.tip_relief.height",
          "no effect"},
  }));
  // These are judged when the task is to optimise.
  const bool is_about_task = key == "optimise.variables" || advice == "no constraints" || advice == "gradients and constraints only";
  const StudyProblem problem = problem_of(optimise + more, is_about_task ? std::vector<Override>{{"task", "optimise"}} : std::vector<Override>{});
  CHECK(problem.key == key);
  CHECK_THAT(problem.allowed, Catch::Contains(advice));
}

TEST_CASE("A relief with an amount needs its height", "[studies][study-file]") {
  const StudyProblem problem = problem_of("[pinion.modification]\nroot_relief = { amount = 8 }\n");
  CHECK(problem.key == "pinion.modification.root_relief.height");
  CHECK(problem.line == 14);
  CHECK_NOTHROW(read("[pinion.modification]\nroot_relief = { amount = 0, height = 0 }\n"));
}

TEST_CASE("A scene in which gears cannot mesh is refused at its line", "[studies][study-file]") {
  const StudyProblem close = problem_of("[[scenes]]\n[[scenes]]\nname = \"close\"\nmisalignment.centre_distance = -10\n");
  CHECK(close.key == "scenes.1.misalignment.centre_distance");
  CHECK(close.line == 16);
  CHECK_THAT(close.allowed, Catch::Contains("tip meets the mate's root circle"));
  CHECK_NOTHROW(read("[misalignment]\ncentre_distance = -0.5\n"));  // addendum 1, dedendum 1.25: 1 mm of clearance
  // Module 4 at 20 deg of helix, b = 40: the overlap alone is 1.09, until tips pass each other at a distance of 8 mm more.
  const StudyProblem apart = problem_of("[misalignment]\ncentre_distance = 9\n");
  CHECK(apart.key == "misalignment.centre_distance");
  CHECK_THAT(apart.allowed, Catch::Contains("total contact ratio of at least 1"));
  CHECK_NOTHROW(read("[misalignment]\ncentre_distance = 2\n"));
  CHECK(problem_of("[misalignment]\ncentre_distance = 5\n", {{"pair.helix_angle", "0"}}).key == "misalignment.centre_distance");
  CHECK(problem_of("[misalignment]\naxial_offset = 39.9\n").key == "misalignment.axial_offset");  // of faces of 40 mm
  CHECK_NOTHROW(read("[misalignment]\naxial_offset = 39\n"));
}

TEST_CASE("What a study varies or differentiates by must act", "[studies][study-file][effects]") {
  const std::string listed = "[load]\ntorque = 300\n[fidelity]\ncompliance = \"thin_slice\"\neffects = [\"bending\", \"hertzian_contact\", \"";
  const std::string misalignment = listed + "misalignment\"]\n", modifications = listed + "modifications\"]\n";
  const auto left_out = [](const std::string& effect) { return Catch::Contains("fidelity.effects leaves \"" + effect + "\" out"); };
  const std::string variables =
      "[optimise]\nobjective = \"peak_contact_stress\"\n[optimise.variables]\n\"pinion.modification.lead_crowning\" = [0, 30]\n";
  CHECK_THAT(problem_of(misalignment + variables, {{"task", "optimise"}}).allowed, left_out("modifications"));
  CHECK_NOTHROW(read(modifications + variables, {{"task", "optimise"}}));
  CHECK_NOTHROW(read(misalignment + variables));  // of a task that varies nothing
  const std::string parameters =
      "[sweep]\nsamples = 16\n[sweep.parameters]\n\"misalignment.mesh_misalignment\" = { normal = [0, 6] }\n\"load.torque\" = { uniform = [200, 300] }\n";
  const StudyProblem swept = problem_of(modifications + parameters, {{"task", "sweep"}});
  CHECK(swept.key == "sweep.parameters.misalignment.mesh_misalignment");
  CHECK_THAT(swept.allowed, left_out("misalignment"));
  CHECK_NOTHROW(read(misalignment + parameters, {{"task", "sweep"}}));
  const std::string gradients = "[analyse]\ngradients = [\"pinion.modification.lead_crowning\", \"misalignment.crossing\", \"load.torque\"]\n";
  CHECK(problems_of(small_study + misalignment + gradients).size() == 1);
  CHECK(problems_of(small_study + modifications + gradients).size() == 1);
  CHECK_THAT(problem_of(gradients, {{"fidelity.compliance", "rigid"}}).allowed, Catch::Contains("no loaded contact"));
}

TEST_CASE("Lines of contact of a spur pair cut off no corner for a triangular relief", "[studies][study-file]") {
  const std::string relief = "[pinion.modification]\ntriangular_tip_relief = { amount = 8, height = 2 }\n";
  CHECK_NOTHROW(read(relief));
  const StudyProblem problem = problem_of(relief, {{"pair.helix_angle", "0"}});
  CHECK(problem.key == "pinion.modification.triangular_tip_relief.amount");
  CHECK_THAT(problem.allowed, Catch::Contains("a helical pair"));
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
      Row{"[fidelity]\ngap = \"whole_plane\"\n", "whole_surface"},
      Row{"[fidelity]\neffects = [\"bendig\"]\n", "bending"},
      Row{"[fidelity]\nquadrature = 3\n", "table"},
      Row{"[wheel]\n", "redefine"},
      Row{"[sweep]\nsamples = 0\n", "1 .. 4294967295"},
      Row{"[pinion.modification]\nparabolic_te = -0.1\n", "0 .. 1000 arcsec/deg^2"},
      Row{"[pinion.modification]\nparabolic_te = 100\n", "over a whole pitch"},
      Row{"[unloaded]\nmarking_thickness = 0\n", "above 0"},
  }));
  const StudyProblem problem = problem_of(more);
  CHECK(problem.line >= 13);
  CHECK_THAT(problem.allowed, Catch::Contains(allowed));
}

TEST_CASE("All problems come at once, in the order of the lines, as file:line:column", "[studies][study-file]") {
  const std::string text = R"(task = "accurate"
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
  CHECK_THROWS_WITH(parse_study(text, "small.toml"), Catch::Contains("small.toml:8:1: wheel.teeth = \"many\": allowed"));
}

TEST_CASE("A number in a key from the command line counts tables that the study has", "[studies][study-file]") {
  const std::vector<Override> first{{"scenes.0.load.torque", "3"}}, third{{"scenes.2.load.torque", "3"}}, shaft{{"unit.shafts.0.name", "a"}};
  CHECK_THAT(problem_of("", first).allowed, Catch::Contains("it has no [[scenes]]"));
  CHECK_THAT(problem_of("", shaft).allowed, Catch::Contains("it has no [[unit.shafts]]"));
  CHECK_THAT(problem_of("[[scenes]]\nname = \"a\"\n", third).allowed, Catch::Contains("counted from 0"));
}

TEST_CASE("A misspelt key names the key that was meant", "[studies][study-file]") {
  using Row = std::tuple<std::string, std::string>;
  const auto [more, meant] = GENERATE(table<std::string, std::string>({
      Row{"[pinion.modification]\nled_crowning = 3\n", "lead_crowning"},
      Row{"[misalignment]\ncenter_distance = 0.1\n", "centre_distance"},
      Row{"[pinon]\nx = 1\n", "pinion"},
      Row{"[optimize]\nx = 1\n", "optimise"},
      Row{"[misalignment]\nmesh = 3\n", "mesh_misalignment"},
      Row{"[fidelity]\npositions = 3\n", "cycle.positions"},
      Row{"[[scenes]]\nmisalignment.crosing = 3\n", "crossing"},
  }));
  CHECK_THAT(problem_of(more).allowed, Catch::Contains("did you mean " + meant + "?"));
}

TEST_CASE("Geometry that cannot be built is reported at its key", "[studies][study-file]") {
  const std::vector<StudyProblem> problems = problems_of(replaced(small_study, "helix_angle = 20", "helix_angle = 20\ncentre_distance = 50"));
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().key == "pair.centre_distance");
  CHECK(problems.front().line == 5);
}

TEST_CASE("Text that is not TOML is one problem with line and column and no key", "[studies][study-file]") {
  const std::vector<StudyProblem> problems = problems_of("title = \"x\"\n[pair\n");
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().line == 2);
  CHECK(problems.front().column > 1);
  CHECK(problems.front().key.empty());
}

}  // namespace flankwright::studies
