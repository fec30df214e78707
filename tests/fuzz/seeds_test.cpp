#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <vector>

#include "studies/base/results_folder.hpp"
#include "tests/fuzz/readers.hpp"

using namespace flankwright::studies;

namespace {

std::vector<std::filesystem::path> seeds(const std::string& reader) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(FLANKWRIGHT_SOURCE_DIR) / "tests/fuzz/seeds" / reader))
    files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// The seed, and what is left of it when it is cut off at sixteen places.
template <typename Read>
void run(const std::string& reader, const Read& read) {
  const auto files = seeds(reader);
  REQUIRE(files.size() >= 3);
  for (const auto& file : files) {
    CAPTURE(file);
    const std::string text = read_whole(file);
    for (std::size_t part = 0; part <= 16; ++part) CHECK_NOTHROW(read(std::string_view(text).substr(0, text.size() * part / 16)));
  }
}

}  // namespace

// Files that once made a reader fail otherwise than with InvalidInput stay here for good.
TEST_CASE("Study files of the fuzzer's seeds are read or refused", "[studies][fuzz]") { run("study", fuzz::read_study_text); }
TEST_CASE("Grid files of the fuzzer's seeds are read or refused", "[studies][fuzz]") { run("grid", fuzz::read_grid_text); }
TEST_CASE("REXS files of the fuzzer's seeds are read or refused", "[studies][fuzz]") { run("rexs", fuzz::read_rexs_text); }
