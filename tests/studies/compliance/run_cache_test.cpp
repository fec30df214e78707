#include "studies/compliance/run_cache.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "tests/studies/command_line.hpp"

namespace flankwright::studies {

using command_line::ScratchFolder;
using command_line::text_of;

namespace {

const Json run_key{{"teeth", 18}, {"face_width", 12.1}, {"tip_diameter", NAN}};  // not given

StoredRun sample() {
  StoredRun run;
  run.facts = {{"unknowns", 1234}, {"lowest_eigenvalue", -1.0 / 3}};
  run.matrices.emplace_back("first", Eigen::MatrixXd::Random(3, 4));
  run.matrices.emplace_back("second", Eigen::MatrixXd::Constant(2, 2, 1e-300));
  return run;
}

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

}  // namespace

TEST_CASE("A kept run comes back to the last bit", "[studies][cache]") {
  const ScratchFolder folder;
  const RunCache cache(folder.path() / "made" / "when needed");
  std::vector<std::string> notes;
  CHECK(!cache.find(run_key, notes));
  const StoredRun run = sample();
  REQUIRE(cache.store(run_key, run, notes));
  const auto found = cache.find(run_key, notes);
  REQUIRE(found);
  CHECK(found->facts == run.facts);
  REQUIRE(found->matrices.size() == 2);
  CHECK(*found->find("first") == run.matrices[0].second);
  CHECK(*found->find("second") == run.matrices[1].second);
  CHECK(found->find("third") == nullptr);
  CHECK(notes.empty());
  Json other = run_key;
  other["teeth"] = 19;
  CHECK(!cache.find(other, notes));
  CHECK(notes.empty());
}

TEST_CASE("A file that is damaged, cut short or of another gear is not used, and a note says why", "[studies][cache]") {
  const ScratchFolder folder;
  const RunCache cache(folder.path());
  std::vector<std::string> notes;
  REQUIRE(cache.store(run_key, sample(), notes));
  const std::filesystem::path file = cache.file_of(run_key);
  const std::string whole = text_of(file);

  std::string changed = whole, why = "it is damaged";
  SECTION("one bit of a number") { changed[changed.size() - 5] ^= 1; }
  SECTION("a fact") { changed[changed.find("1234")] = '9'; }
  SECTION("half of it") { changed.resize(changed.size() / 2); }
  SECTION("its first line only") { changed.resize(changed.find('\n') + 1); }
  SECTION("nothing at all") {
    changed.clear();
    why = "it is of another kind or version";
  }
  SECTION("a later version") {
    changed.replace(changed.find(" 1 "), 3, " 2 ");
    why = "it is of another kind or version";
  }
  SECTION("something else") {
    changed = "teeth = 18\n";
    why = "it is of another kind or version";
  }
  SECTION("another gear's under this gear's name") {
    const Json other{{"teeth", 19}};
    REQUIRE(cache.store(other, sample(), notes));
    changed = text_of(cache.file_of(other));
    why = "it belongs to another gear";
  }
  write(file, changed);
  CHECK(!cache.find(run_key, notes));
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Catch::Contains(file.string()) && Catch::EndsWith(why));
  // Kept again, it is whole again.
  REQUIRE(cache.store(run_key, sample(), notes));
  CHECK(cache.find(run_key, notes));
}

TEST_CASE("A folder that cannot be written costs a note and nothing else", "[studies][cache]") {
  const ScratchFolder folder;
  folder.file("file", "text");
  const RunCache cache(folder.path() / "file" / "below");
  std::vector<std::string> notes;
  CHECK(!cache.store(run_key, sample(), notes));
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Catch::Contains("not kept"));
  CHECK(!cache.find(run_key, notes));
}

TEST_CASE("The folder of kept runs follows the environment", "[studies][cache]") {
  const auto value_of = [](const char* name) { return std::string(std::getenv(name) ? std::getenv(name) : ""); };
  const std::string own = value_of("FLANKWRIGHT_CACHE"), caches = value_of("XDG_CACHE_HOME");
  ::setenv("FLANKWRIGHT_CACHE", "/a", 1);
  ::setenv("XDG_CACHE_HOME", "/b", 1);
  CHECK(RunCache::default_folder() == "/a");
  ::unsetenv("FLANKWRIGHT_CACHE");
  CHECK(RunCache::default_folder() == "/b/flankwright");
  ::unsetenv("XDG_CACHE_HOME");
  CHECK(RunCache::default_folder() == std::filesystem::path(value_of("HOME")) / ".cache" / "flankwright");
  if (!own.empty()) ::setenv("FLANKWRIGHT_CACHE", own.c_str(), 1);
  if (!caches.empty()) ::setenv("XDG_CACHE_HOME", caches.c_str(), 1);
}

}  // namespace flankwright::studies
