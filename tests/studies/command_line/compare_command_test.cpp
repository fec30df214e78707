#include <catch2/catch.hpp>

#include "tests/studies/command_line.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"

namespace flankwright::studies {

using Catch::Contains;
using command_line::Ending;
using command_line::run;
using command_line::ScratchFolder;
using command_line::text_of;

namespace {

const std::string geometry_study = "task = \"geometry\"\n" + study_texts::small_study;

}  // namespace

TEST_CASE("A run that is compared with itself differs in nothing; another study is listed with exit code 1", "[studies][cli]") {
  const ScratchFolder folder;
  folder.file("small.toml", small::analysis());
  REQUIRE(run(folder, {"run", "small.toml", "--out", "a"}).exit_code == 0);
  REQUIRE(run(folder, {"run", "small.toml", "--out", "b", "--threads", "1"}).exit_code == 0);
  REQUIRE(run(folder, {"run", "small.toml", "--out", "c", "--set", "load.torque=1020"}).exit_code == 0);
  const Ending same = run(folder, {"compare", "a", "b", "--tolerance", "0%"});
  CAPTURE(same.out, same.err);
  CHECK(same.exit_code == 0);
  CHECK_THAT(same.out, Contains("peak contact stress") && !Contains("keys that differ") && Contains("report: comparison/comparison.html"));
  CHECK(folder.names("comparison") == std::vector<std::string>{"comparison.csv", "comparison.html"});
  const Ending other = run(folder, {"compare", "a", "c", "--tolerance", "1%", "--out", "x"});
  CHECK(other.exit_code == 1);
  CHECK_THAT(other.out, Contains("load.torque") && Contains("more than 1% from a") && Contains("only one has it"));
  CHECK(run(folder, {"compare", "a", "c", "--out", "x"}).exit_code == 0);  // without a tolerance differences are shown and no matter
}

TEST_CASE("What cannot be compared is bad input", "[studies][cli]") {
  const ScratchFolder folder;
  CHECK(run(folder, {"compare", "a"}).exit_code == 2);
  CHECK(run(folder, {"compare", "a", "b"}).exit_code == 2);
  CHECK(run(folder, {"compare", "a", "b", "--tolerance", "1"}).exit_code == 2);
  CHECK(folder.names().empty());
}

TEST_CASE("A folder of studies runs with a line for each; a wrong one does not keep the others from running", "[studies][cli]") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "gears");
  folder.file("gears/first.toml", geometry_study);
  folder.file("gears/second.toml", geometry_study + "[expect]\n\"geometry.pinion.teeth\" = { max = 10 }\n");
  const Ending differing = run(folder, {"run", "gears", "--out", "r"});
  CHECK(differing.exit_code == 1);
  CHECK_THAT(differing.out, Contains("first") && Contains("done") && Contains("second") && Contains("not as expected"));
  folder.file("gears/third.toml", "[pair]\n");
  const Ending wrong = run(folder, {"run", "gears", "--out", "r"});
  CHECK(wrong.exit_code == 2);
  CHECK_THAT(wrong.out, Contains("third") && Contains("wrong input"));
  CHECK_THAT(wrong.err, Contains("gears/third.toml"));
  CHECK(folder.names("r") == std::vector<std::string>{"first", "second", "studies.csv"});
  CHECK_THAT(text_of(folder.path() / "r" / "studies.csv"),
             Contains("study,task,state,seconds,total_contact_ratio") && Contains("first,geometry,done,"));
  CHECK(run(folder, {"run", "gears", "--shard", "1/2"}).exit_code == 2);
}

}  // namespace flankwright::studies
