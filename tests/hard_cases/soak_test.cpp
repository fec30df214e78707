#include <catch2/catch.hpp>
#include <filesystem>
#include <map>

#include "studies/base/results_folder.hpp"
#include "tests/hard_cases/random_study.hpp"
#include "tests/hard_cases/scene_check.hpp"
#include "tests/studies/command_line.hpp"

using namespace flankwright;
using namespace flankwright::hard_cases;

namespace {

void check_random_scenes(int scenes) {
  std::map<int, int> counts;
  for (int i = 0; i < scenes; ++i) {
    const SceneVerdict verdict = examine(random_study(20261121, static_cast<std::uint64_t>(i)), "scene");
    ++counts[verdict.kind];
    CAPTURE(i, verdict.why);
    CHECK(verdict.kind != SceneVerdict::Failed);
  }
  CHECK(counts[SceneVerdict::Passed] >= scenes / 2);  // most can be built
  CHECK(counts[SceneVerdict::Refused] > 0);           // and the border is crossed
}

}  // namespace

TEST_CASE("Hard: random scenes keep every property", "[hard_cases]") { check_random_scenes(100); }

TEST_CASE("Hard: five thousand random scenes keep every property", "[.soak][hard_cases]") { check_random_scenes(5000); }

TEST_CASE("Hard: a saved scene is a study that the user can run, and the same one", "[hard_cases]") {
  const studies::command_line::ScratchFolder folder;
  const std::string study = random_study(7, 1);
  CHECK(random_study(7, 1) == study);
  CHECK(random_study(8, 1) != study);
  CHECK(random_study(7, 2) != study);
  const std::string file = save_scene((folder.path() / "failures").string(), study, 7, 1, "a reason\nin two lines");
  CHECK(std::filesystem::path(file).filename() == "scene-7-1.toml");
  const std::string saved = studies::read_whole(file);
  CHECK(saved == "# seed 7, index 1\n# a reason in two lines\n" + study);
  CHECK(examine(saved, file).kind == examine(study, "scene").kind);
  CHECK(studies::command_line::run(folder, {"check", file}).exit_code == (examine(study, "scene").kind == SceneVerdict::Refused ? 2 : 0));
}
