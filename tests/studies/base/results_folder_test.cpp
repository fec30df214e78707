#include "studies/base/results_folder.hpp"

#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/small_file_limit.hpp"

namespace flankwright::studies {

using command_line::ScratchFolder;
using command_line::text_of;
using Names = std::vector<std::string>;

TEST_CASE("A file is written whole, replaced whole, and leaves nothing beside it", "[studies][results]") {
  const ScratchFolder folder;
  const std::string large(3'000'000, 'x');
  write_whole(folder.path() / "a.txt", large);
  CHECK(text_of(folder.path() / "a.txt") == large);
  write_whole(folder.path() / "a.txt", "");
  CHECK(text_of(folder.path() / "a.txt").empty());
  CHECK(folder.names() == Names{"a.txt"});
}

TEST_CASE("A folder that cannot be written is refused and nothing half-written stays", "[studies][results]") {
  const ScratchFolder folder;
  folder.file("file", "text");
  std::filesystem::create_directory(folder.path() / "taken");
  for (const char* place : {"no-such-folder/a.txt", "file/a.txt", "taken"}) {
    CAPTURE(place);
    try {
      write_whole(folder.path() / place, "text");
      FAIL("was written");
    } catch (const InvalidInput& problem) {
      CHECK(problem.field() == "output folder");
      CHECK_THAT(problem.value(), Catch::EndsWith(place));
    }
  }
  CHECK_THROWS_AS(make_folder(folder.path() / "file" / "below"), InvalidInput);
  CHECK_THROWS_AS(make_folder(folder.path() / "file"), InvalidInput);
  CHECK(folder.names() == Names{"file", "taken"});
}

TEST_CASE("A disk that fills up half-way leaves the old file as it was", "[studies][results]") {
  const ScratchFolder folder;
  write_whole(folder.path() / "a.txt", "old");
  {
    const SmallFileLimit limit(1000);
    CHECK_THROWS_AS(write_whole(folder.path() / "a.txt", std::string(5000, 'x')), InvalidInput);
  }
  CHECK(text_of(folder.path() / "a.txt") == "old");
  CHECK(folder.names() == Names{"a.txt"});
}

TEST_CASE("results.json that is missing, damaged or of something else is refused", "[studies][results]") {
  const ScratchFolder folder;
  CHECK_THROWS_AS(whole_results(folder.path()), InvalidInput);
  const std::string head = "{\"given\": [], \"used\": [], \"version\": \"1\"";
  for (const std::string& text : {std::string(), std::string("no json"), std::string("{}"), std::string("[1, 2]"), head, head + ", \"loaded\": 3}",
                                  head + ", \"title\": \"\xff\"}", head + ", \"x\": 1e999}"}) {
    CAPTURE(text);
    folder.file("results.json", text);
    CHECK_THROWS_AS(whole_results(folder.path()), InvalidInput);
  }
  folder.file("results.json", head + "}");
  CHECK(whole_results(folder.path()).at("version") == "1");
}

TEST_CASE("Folders are made with their parents, files are read as they are", "[studies][results]") {
  const ScratchFolder folder;
  make_folder(folder.path() / "a" / "b");
  make_folder(folder.path() / "a" / "b");
  CHECK(std::filesystem::is_directory(folder.path() / "a" / "b"));
  const std::string bytes("a\0\r\n\xff", 5);
  folder.file("bytes", bytes);
  CHECK(read_whole(folder.path() / "bytes") == bytes);
  CHECK_THROWS_AS(read_whole(folder.path() / "missing"), InvalidInput);
  CHECK_THROWS_AS(read_whole(folder.path() / "a"), InvalidInput);
}

}  // namespace flankwright::studies
