#include "studies/tasks/study_template.hpp"

#include <catch2/catch.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("Every template is a study that can be read as it is", "[studies][template]") {
  CHECK(parse_study(study_template("analyse"), "analyse.toml").task == &find_task("analyse"));
  const Study optimise = parse_study(study_template("optimise"), "optimise.toml");
  CHECK(optimise.task == &find_task("optimise"));
  CHECK(optimise.scenes.size() == 3);
  CHECK(optimise.table<OptimiseTable>().variables.size() == 3);
  const Study sweep = parse_study(study_template("sweep"), "sweep.toml");
  CHECK(sweep.task == &find_task("sweep"));
  CHECK(sweep.table<SweepTable>().parameters.size() == 6);  // a tolerance class of a gear's error is three
  const Study accuracy = parse_study(study_template("accuracy"), "accuracy.toml");
  CHECK(accuracy.task == &find_task("accuracy"));
  CHECK(accuracy.scenes.size() == 2);
  CHECK(parse_study(study_template("fit"), "fit.toml").task == &find_task("fit"));
}

TEST_CASE("The job script for Slurm has as many tasks as shards", "[studies][template]") {
  const std::string script = study_template("slurm");
  std::smatch array, shards;
  REQUIRE(std::regex_search(script, array, std::regex("#SBATCH --array=1-(\\d+)")));
  REQUIRE(std::regex_search(script, shards, std::regex("\nshards=(\\d+)")));
  CHECK(script.starts_with("#!/bin/bash\n"));
  CHECK(array[1] == shards[1]);
}

TEST_CASE("Every line that a template offers in a comment can be switched on", "[studies][template]") {
  const std::string kind = GENERATE("analyse", "optimise", "sweep", "accuracy", "fit", "geometry");
  const std::vector<std::string> lines = lines_of(study_template(kind));
  const std::regex offered("# ([a-z_]+ = .*)");
  int switched_on = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::smatch match;
    if (!std::regex_match(lines[i], match, offered)) continue;
    std::string text;
    for (std::size_t j = 0; j < lines.size(); ++j) text += (i == j ? match[1].str() : lines[j]) + "\n";
    CAPTURE(lines[i]);
    CHECK_NOTHROW(parse_study(text, "template.toml"));
    ++switched_on;
  }
  CHECK(switched_on >= (kind == "fit" ? 5 : 10));
}

TEST_CASE("Unknown templates are refused by name", "[studies][template]") { CHECK_THROWS_AS(study_template("anything"), InvalidInput); }

TEST_CASE("Every default of the schema is a value that its key accepts", "[studies][schema]") {
  for (const SchemaKey& key : study_schema()) {
    if (is_described_fallback(key) || key.path.find("[]") != std::string::npos) continue;
    CAPTURE(key.path);
    // Where two keys exclude each other, the override removes the other one.
    CHECK_NOTHROW(parse_study(study_template("optimise"), "optimise.toml",
                              {{key.path, key.fallback},
                               {"task", "analyse"},
                               {"pinion.modification.tip_relief", "{ amount = 1, height = 1 }"},
                               {"wheel.modification.tip_relief", "{ amount = 1, height = 1 }"}}));
  }
}

TEST_CASE("Keys of the schema are unique and have a meaning", "[studies][schema]") {
  std::map<std::string, int> count;
  for (const SchemaKey& key : study_schema()) {
    CAPTURE(key.path);
    CHECK(++count[key.path] == 1);
    CHECK(!key.meaning.empty());
    CHECK(!key.fallback.empty());
  }
}
