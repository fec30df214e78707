#include <algorithm>
#include <catch2/catch.hpp>

#include "studies/base/json_format.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/small_studies.hpp"

namespace flankwright::studies {

using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;
using command_line::Ending;
using command_line::run;
using command_line::ScratchFolder;
using command_line::text_of;
using Names = std::vector<std::string>;

TEST_CASE("A run leaves its files in the folder it was given, a table on stdout and nothing else", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::analysis());
  const Ending ending = run(folder, {"run", "small.toml", "--out", "here/and there"});
  CAPTURE(ending.err);
  CHECK(ending.exit_code == 0);
  CHECK(folder.names() == Names{"here", "small.toml"});
  CHECK(folder.names("here/and there") == Names{"bearing_pattern.csv", "cycle.csv", "effects.csv", "gears.csv", "given.csv", "harmonics.csv",
                                                "load_factors.csv", "load_sharing.csv", "points.csv", "report.html", "results.json", "steps.csv",
                                                "summary.csv", "transfers.csv", "unloaded.csv", "used.csv"});
  CHECK_THAT(ending.out, Contains("aligned") && Contains("bent") && Contains("report: here/and there/report.html"));
  CHECK(ending.out.find("analysing") == std::string::npos);
  CHECK_THAT(ending.err, Contains("small analysis"));
}

TEST_CASE("An optimisation also leaves its store; the default folder carries the study's name", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::optimisation());
  const Ending ending = run(folder, {"run", "small.toml", "--threads", "1"});
  CAPTURE(ending.err);
  CHECK(ending.exit_code == 0);
  CHECK(folder.names("results/small") == Names{"comparison.csv", "cycle.csv", "design.csv", "effects.csv", "gears.csv", "given.csv", "harmonics.csv",
                                               "history.csv", "load_factors.csv", "load_sharing.csv", "points.csv", "report.html", "results.json",
                                               "results.sqlite", "scenes.csv", "sensitivity.csv", "steps.csv", "summary.csv", "used.csv"});
}

TEST_CASE("Settings of the command line replace those of the file", "[studies][cli][slow]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::analysis());
  const Ending ending = run(folder, {"run", "small.toml", "--out", "r", "--set", "cycle.positions=4", "--set", "load.torque=500", "--set",
                                     "scenes.1.misalignment.crossing=2 arcmin", "--set", "title=two words"});
  CAPTURE(ending.err);
  REQUIRE(ending.exit_code == 0);
  const Json results = Json::parse(text_of(folder.path() / "r" / "results.json"));
  CHECK(results["title"] == "two words");
  CHECK(results["loaded"][1]["torque_Nm"] == 500.0);
  CHECK(results["loaded"][1]["cycle"].size() == 4);
  CHECK_FALSE(results.contains("unloaded"));
}

TEST_CASE("A start outside the constraints is said before the search", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::optimisation() + "\"pinion.modification.lead_crowning + wheel.modification.lead_crowning\" = { min = 25 }\n");
  const Ending ending = run(folder, {"run", "small.toml", "--set", "optimise.comparison.rules=off"});
  CHECK(ending.exit_code == 0);
  const std::size_t said = ending.err.find("the search starts outside the constraints: the constraint on pinion.modification.lead_crowning");
  CHECK(said < ending.err.find("optimising"));
}

TEST_CASE("A check says the backlash that a given centre distance leaves", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::analysis());
  CHECK_THAT(run(folder, {"check", "small.toml"}).out, !Contains("backlash"));
  // Of a spur pair: j_wt = 2 tan(alpha_wt) (a - a_0) to first order, j_bn = j_wt cos(alpha_wt) cos(beta_b).
  const Ending ending = run(folder, {"check", "small.toml", "--set", "pair.helix_angle=0", "--set", "pair.centre_distance=360.1"});
  CHECK(ending.exit_code == 0);
  const Ending thinner =
      run(folder, {"check", "small.toml", "--set", "pinion.tooth_thickness_allowance=-50", "--set", "wheel.tooth_thickness_allowance=-70"});
  CHECK_THAT(thinner.out, Contains("112.8 um normal to the flanks (j_bn)") && Contains("allowances of -50 um on the pinion and -70 um on the wheel"));
  CHECK_THAT(ending.out, Contains("backlash 72.") && Contains("at the centre distance of 360.1 mm (none at 360 mm)"));
  const Ending jam = run(folder, {"check", "small.toml", "--set", "pair.helix_angle=0", "--set", "pair.centre_distance=359.9"});
  CHECK(jam.exit_code == 0);
  CHECK_THAT(jam.err, Contains("the teeth overlap by 72."));
}

TEST_CASE("What cannot be printed ends in one line, with the exit code of bad input", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::analysis());
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"new", "analyse"}, {"keys"}, {"--help"}, {"check", "small.toml"}, {"run", "small.toml", "--out", "r", "--set", "cycle.positions=4"}}) {
    const Ending ending = run(folder, command, "/dev/full");
    CAPTURE(command.front());
    CHECK(ending.exit_code == 2);
    CHECK_THAT(ending.err, EndsWith("standard output = not written: allowed is a place that can be written (No space left on device)\n"));
  }
}

TEST_CASE("A loop of symbolic links is a file that cannot be read", "[studies][cli]") {
  const ScratchFolder folder;
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  CHECK_THAT(run(folder, {"test", "loop"}).out, Contains("loop: the file cannot be read"));
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"test", "loop"}, {"check", "loop"}, {"run", "loop"}, {"report", "loop"}, {"import", "loop"}, {"export", "loop", "--rexs"}}) {
    const Ending ending = run(folder, command);
    CAPTURE(command.front(), ending.err);
    CHECK(ending.exit_code == 2);
    CHECK(ending.err.find("internal") == std::string::npos);
  }
  folder.file("small.toml", small::analysis());
  const Ending ending = run(folder, {"run", "small.toml", "--out", "loop"});
  CHECK(ending.exit_code == 2);
  CHECK_THAT(ending.err, Contains("a place that can be written"));
}

TEST_CASE("No control character of a file reaches the terminal", "[studies][cli]") {
  const ScratchFolder folder;
  const std::string escape = "\\u001B[2J";
  folder.file("key.toml", "\"" + escape + "\" = 1\n" + small::analysis());
  folder.file("title.toml", small::analysis() + "[[scenes]]\nname = \"" + escape + "\"\n");
  folder.file("grid.csv", "radius_mm,z_mm,deviation_um\n50,0,\x1b[2J\n");
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"check", "key.toml"}, {"check", "title.toml"}, {"import", "grid.csv"}}) {
    const Ending ending = run(folder, command);
    CAPTURE(command.back(), ending.err);
    CHECK(ending.exit_code == 2);
    CHECK(ending.err.find('\x1b') == std::string::npos);
  }
}

TEST_CASE("The results do not depend on the number of threads", "[studies][cli][determinism]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::optimisation());
  REQUIRE(run(folder, {"run", "small.toml", "--out", "one", "--threads", "1"}).exit_code == 0);
  REQUIRE(run(folder, {"run", "small.toml", "--out", "two", "--threads", "2"}).exit_code == 0);
  for (const char* table : {"cycle.csv", "history.csv", "load_factors.csv", "load_sharing.csv", "points.csv", "scenes.csv"}) {
    CAPTURE(table);
    CHECK(text_of(folder.path() / "one" / table) == text_of(folder.path() / "two" / table));
  }
}

TEST_CASE("Everything that is wrong with a study is said at once, with line and column", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("bad.toml",
              "[pair]\nnormal_module = -10\nhelix_angel = 30\n[pinion]\nteeth = 2\nface_width = \"120 s\"\n"
              "[wheel]\nteeth = 54\nface_width = 120\n[cycle]\npositions = 0\n");
  for (const char* command : {"check", "run"}) {
    const Ending ending = run(folder, {command, "bad.toml"});
    CAPTURE(command, ending.err);
    CHECK(ending.exit_code == 2);
    CHECK(ending.out.empty());
    for (const char* said :
         {"bad.toml:2:1: pair.normal_module = -10: allowed is ", "bad.toml:3:1: pair.helix_angel = 30: unknown key",
          "bad.toml:5:1: pinion.teeth = 2: allowed is ", "bad.toml:6:1: pinion.face_width = ", "bad.toml:11:1: cycle.positions = 0: allowed is "}) {
      CHECK_THAT(ending.err, Contains(said));
    }
    CHECK(std::count(ending.err.begin(), ending.err.end(), '\n') == 5);
  }
  CHECK(folder.names() == Names{"bad.toml"});  // no results folder
}

TEST_CASE("Check warns of what a run would warn of first", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::analysis());
  const Ending sound = run(folder, {"check", "small.toml", "--set", "pinion.process=topological"});
  CHECK(sound.exit_code == 0);
  CHECK(sound.err.empty());
  CHECK_THAT(run(folder, {"check", "small.toml"}).err, Contains("warning: the pinion's process is \"none\""));
  const Ending undercut = run(folder, {"check", "small.toml", "--set", "pinion.teeth=9", "--set", "pinion.profile_shift=-0.3"});
  CAPTURE(undercut.err);
  CHECK(undercut.exit_code == 0);
  CHECK_THAT(undercut.err, Contains("warning: the pinion is undercut"));
  const Ending stubbed = run(folder, {"check", "small.toml", "--set", "wheel.tip_diameter=625", "--set", "pinion.modification.dedendum_crowning=5"});
  CAPTURE(stubbed.err);
  CHECK_THAT(stubbed.err, Contains("the pinion's dedendum touches over a height of"));
  CHECK_THAT(run(folder, {"check", "small.toml", "--set", "pair.centre_distance=424"}).err, Contains("the transverse contact ratio is 0.709"));
  const std::vector<std::string> oil{"check", "small.toml",
                                     "--set", "lubricant.viscosity_40=220",
                                     "--set", "lubricant.viscosity_100=19",
                                     "--set", "lubricant.temperature=80",
                                     "--set", "lubricant.roughness=0.5",
                                     "--set", "load.speed=1500"};
  CHECK_THAT(run(folder, oil).err, !Contains("Ohlendorf"));
  std::vector<std::string> apart = oil;
  apart.insert(apart.end(), {"--set", "pair.centre_distance=424"});
  CHECK_THAT(run(folder, apart).err, Contains("Ohlendorf's loss factor"));
}

TEST_CASE("Any other bad input has exit code 2 and a message with the allowed values", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::analysis());
  folder.file("broken.toml", "title = \"no end\n");
  struct Case {
    std::vector<std::string> arguments;
    const char* said;
  };
  const std::vector<Case> cases{{{}, "subcommand"},
                                {{"chekc", "small.toml"}, "command = chekc: allowed is one of run, merge, check"},
                                {{"chekc"}, "did you mean check?"},
                                {{"run"}, "study is required"},
                                {{"run", "missing.toml"}, "missing.toml: the file cannot be read"},
                                {{"run", "broken.toml"}, "broken.toml:1:"},
                                {{"run", "small.toml", "--set", "nothing"}, "key.path=value"},
                                {{"run", "small.toml", "--set", "pinion.teeth=2"}, "--set: pinion.teeth = 2: allowed is an integer 5 .. 1000"},
                                {{"run", "small.toml", "--threads", "0"}, "threads"},
                                {{"run", "small.toml", "--out", "small.toml/below"}, "output folder"},
                                {{"check", "small.toml", "--set", "pair.helix_angle=80"}, "pair.helix_angle"},
                                {{"new", "nonsense"}, "analyse"},
                                {{"report", "missing"}, "folder = missing: allowed is a folder with results.json"},
                                {{"export", "missing", "--rexs"}, "folder = missing: allowed is a folder with results.json"},
                                {{"test", "missing.toml"}, ""}};
  for (const Case& c : cases) {
    const Ending ending = run(folder, c.arguments);
    CAPTURE(c.arguments, ending.out, ending.err);
    CHECK(ending.exit_code == 2);
    CHECK_THAT(ending.err + ending.out, Contains(c.said));
  }
}

TEST_CASE("Help and version are answers, not errors", "[studies][cli]") {
  const ScratchFolder folder;
  const Ending help = run(folder, {"--help"});
  CHECK(help.exit_code == 0);
  for (const char* command : {"run", "check", "new", "report", "test"}) CHECK_THAT(help.out, Contains(command));
  CHECK(run(folder, {"run", "--help"}).exit_code == 0);
  const Ending version = run(folder, {"--version"});
  CHECK(version.exit_code == 0);
  CHECK_THAT(version.out, StartsWith("flankwright "));
}

TEST_CASE("A requirement that is not met is exit code 1, with its results written and the reason in one line", "[studies][cli][slow]") {
  const ScratchFolder folder;
  folder.file("bound.toml", small::optimisation());
  const Ending bound =
      run(folder, {"run", "bound.toml", "--set", "optimise.constraints.te_peak_to_peak.max=0.0001", "--set", "optimise.max_evaluations=30"});
  CHECK(bound.exit_code == 1);
  CHECK_THAT(bound.err, Contains("te_peak_to_peak <= 0.0001 is violated"));
  CHECK(std::filesystem::exists(folder.path() / "results" / "bound" / "results.json"));

  folder.file("expect.toml", small::analysis() + "[expect]\n\"loaded.summary.te_peak_to_peak_um\" = { max = 0.001 }\n");
  const Ending expect = run(folder, {"run", "expect.toml"});
  CHECK(expect.exit_code == 1);
  CHECK_THAT(expect.out, Contains("loaded[1].summary.te_peak_to_peak_um: expected at most 0.001, found "));

  const Ending budget = run(folder, {"run", "bound.toml", "--set", "optimise.max_evaluations=2"});
  CHECK(budget.exit_code == 1);
  CHECK_THAT(budget.err, Contains("ended early (evaluation limit)"));
}

TEST_CASE("Report rebuilds the same page from the stored results", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::analysis());
  REQUIRE(run(folder, {"run", "small.toml", "--out", "r"}).exit_code == 0);
  const std::string page = text_of(folder.path() / "r" / "report.html");
  std::filesystem::remove(folder.path() / "r" / "report.html");
  const Ending ending = run(folder, {"report", "r"});
  CHECK(ending.exit_code == 0);
  CHECK(ending.out == "report: r/report.html\n");
  CHECK(text_of(folder.path() / "r" / "report.html") == page);
  folder.file("r/results.json", "{ half a fi");
  CHECK(run(folder, {"report", "r"}).exit_code == 2);
  folder.file("r/results.json", "{}");
  CHECK_THAT(run(folder, {"report", "r"}).err, Contains("results.json = a damaged or incomplete file"));
  CHECK(text_of(folder.path() / "r" / "report.html") == page);
}

TEST_CASE("The command test runs every study of a folder and reports those that differ", "[studies][cli][slow]") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "set");
  const std::string key = "[expect]\n\"unloaded.mesh.peak_to_peak_arcsec\" = ";
  folder.file("set/a-met.toml", small::analysis() + key + "{ min = 0 }\n");
  folder.file("set/b-none.toml", small::analysis());
  Ending ending = run(folder, {"test", "set"});
  CAPTURE(ending.err);
  CHECK(ending.exit_code == 0);
  CHECK_THAT(ending.out, StartsWith("met ") && Contains("none  set/b-none.toml"));

  folder.file("set/c-differs.toml", small::analysis() + key + "{ max = 0 }\n");
  ending = run(folder, {"test", "set"});
  CHECK(ending.exit_code == 1);
  CHECK_THAT(ending.out, Contains("DIFF  set/c-differs.toml") && Contains("expected at most 0, found "));

  folder.file("set/d-bad.toml", small::analysis() + "[nonsense]\n");
  ending = run(folder, {"test", "set"});
  CHECK(ending.exit_code == 2);
  CHECK_THAT(ending.out, Contains("BAD   set/d-bad.toml") && Contains("nonsense"));
  CHECK(folder.names() == Names{"set"});  // a test leaves no results
}

TEST_CASE("Values of today are accepted into a copy that meets its expectations", "[studies][cli][slow]") {
  const ScratchFolder folder;
  const std::string study = small::analysis() + R"([expect]   # µ-geometry
"loaded.0.summary.te_mean_um" = { value = 1e3, within = "1 %" }   # a guess
"loaded.summary.te_peak_to_peak_um" = { max = 0 }
unloaded.carrying_sequence = { is = "sür" }
)";
  folder.file("study.toml", study);
  const Ending ending = run(folder, {"test", "study.toml", "--accept"});
  CAPTURE(ending.out, ending.err);
  CHECK(ending.exit_code == 1);  // as it is, the study is not met
  CHECK_THAT(ending.out, Contains("2 values of today in study.toml.accepted") && Contains("not accepted: loaded[0].summary.te_peak_to_peak_um"));
  CHECK(text_of(folder.path() / "study.toml") == study);
  const std::string copy = text_of(folder.path() / "study.toml.accepted");
  CHECK_THAT(copy, Contains("[expect]   # µ-geometry\n") && Contains(", within = \"1 %\" }   # a guess") && Contains("{ max = 0 }"));
  folder.file("copy.toml", copy);
  const Ending again = run(folder, {"test", "copy.toml"});
  CHECK(again.exit_code == 1);  // the bound
  CHECK_THAT(again.out, !Contains("te_mean_um") && !Contains("carrying_sequence"));
}

TEST_CASE("A new study is valid, runs and meets its requirements", "[studies][cli][slow]") {
  const std::string kind = GENERATE("analyse", "optimise");
  const ScratchFolder folder;
  const Ending made = run(folder, {"new", kind});
  REQUIRE(made.exit_code == 0);
  folder.file("new.toml", made.out);
  const Ending check = run(folder, {"check", "new.toml"});
  CHECK(check.exit_code == 0);
  CHECK_THAT(check.out, StartsWith("new.toml: valid, task " + kind));
  const Ending ending = run(folder, {"run", "new.toml", "--set", "cycle.positions=8"});
  CAPTURE(ending.err);
  CHECK(ending.exit_code == 0);
}

}  // namespace flankwright::studies
