#include <catch2/catch.hpp>

#include "studies/base/json_format.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/small_studies.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using Catch::Contains;
using command_line::Ending;
using command_line::run;
using command_line::ScratchFolder;
using command_line::text_of;

TEST_CASE("An optimised design goes to REXS and back into a study that check accepts", "[studies][rexs][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::optimisation());
  REQUIRE(run(folder, {"run", "small.toml", "--out", "r"}).exit_code == 0);
  const Ending exported = run(folder, {"export", "r", "--rexs", "--rexsj", "--out", "x"});
  CAPTURE(exported.err);
  REQUIRE(exported.exit_code == 0);
  CHECK(exported.out == "x/stage.rexs\nx/stage.rexsj\n");
  CHECK(folder.names("x") == std::vector<std::string>{"stage.rexs", "stage.rexsj"});
  const Ending imported = run(folder, {"import", "x/stage.rexs", "--out", "deep/back.toml"});
  CHECK(imported.exit_code == 0);
  CHECK(run(folder, {"check", "deep/back.toml"}).exit_code == 0);
  const auto variables = Json::parse(text_of(folder.path() / "r/results.json"))["optimise"]["after"]["variables"];
  const Study back = read_study((folder.path() / "deep/back.toml").string());
  CHECK(back.modification.pinion.lead_crowning == Approx(1e-3 * variables["pinion.modification.lead_crowning"].get<double>()).epsilon(1e-14));
  CHECK(back.modification.pinion.end_relief.amount == Approx(1e-3 * variables["pinion.modification.end_relief.amount"].get<double>()).epsilon(1e-14));

  // As the study gave them: no modification at all.
  REQUIRE(run(folder, {"export", "r", "--rexs", "--given", "--out", "x"}).exit_code == 0);
  const Ending given = run(folder, {"import", "x/stage.rexs"});
  CHECK(given.exit_code == 0);
  CHECK(parse_study(given.out, "given").modification.pinion == Modification{});
}

TEST_CASE("Import and export name what they cannot use", "[studies][rexs][cli][errors]") {
  const ScratchFolder folder;
  folder.file("broken.rexs", "<model>\n<oh>");
  Ending ending = run(folder, {"import", "broken.rexs"});
  CHECK(ending.exit_code == 2);
  CHECK_THAT(ending.err, Contains("broken.rexs:2:1: XML = "));
  CHECK(run(folder, {"import", "absent.rexs"}).exit_code == 2);
  CHECK(run(folder, {"import", "broken.rexs", "--helix-slope", "up"}).exit_code == 2);
  ending = run(folder, {"export", "."});
  CHECK(ending.exit_code == 2);
  CHECK_THAT(ending.err, Contains("no format"));
  folder.file("results.json", "{}");
  CHECK(run(folder, {"export", ".", "--rexs"}).exit_code == 2);
}
