#include "studies/exchange/rexs/rexs_archive.hpp"

#include <zip.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "studies/base/results_folder.hpp"
#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study_file/study_file.hpp"

using namespace flankwright::studies;
using Catch::Contains;

namespace {

/// Bytes of an archive with these entries, name and content.
std::string archive_of(const std::vector<std::pair<std::string, std::string>>& entries) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "flankwright-archive-test.zip";
  int problem = 0;
  zip_t* archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &problem);
  REQUIRE(archive != nullptr);
  for (const auto& [name, content] : entries) {
    REQUIRE(zip_file_add(archive, name.c_str(), zip_source_buffer(archive, content.data(), content.size(), 0), 0) >= 0);
  }
  REQUIRE(zip_close(archive) == 0);
  std::string bytes = read_whole(file);
  std::filesystem::remove(file);
  return bytes;
}

std::string archive_refusal(const std::string& bytes) {
  try {
    rexs::unpack(bytes, "gears.rexsz");
  } catch (const StudyErrors& errors) {
    return errors.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A packed REXS file is the same study as the file in it", "[studies][rexs][import]") {
  const std::string text = read_whole(std::filesystem::path(FLANKWRIGHT_SOURCE_DIR) / "tests/studies/exchange/rexs/data/two_stages.rexs");
  const std::string packed = archive_of({{"picture.png", "no picture"}, {"folder/Gears.REXS", text}});
  REQUIRE(rexs::is_archive(packed));
  CHECK(packed.size() < text.size());
  CHECK(rexs::unpack(packed, "gears.rexsz") == text);
  CHECK(rexs::import_stage(packed, "gears.rexs", {.stage = 1}).text == rexs::import_stage(text, "gears.rexs", {.stage = 1}).text);
}

TEST_CASE("An archive that is damaged, ambiguous or too large is refused in one line", "[studies][rexs][errors][slow]") {
  const std::string packed = archive_of({{"gears.rexs", std::string(5000, 'a')}});
  CHECK(archive_refusal(packed).empty());
  for (const std::size_t left : {4U, 20U, 60U, 100U})
    CHECK_THAT(archive_refusal(packed.substr(0, left)), Contains("gears.rexsz: file = a damaged ZIP archive"));
  std::string bent = packed;
  bent[45] = static_cast<char>(bent[45] ^ 0x55);  // within the packed bytes
  CHECK_THAT(archive_refusal(bent), Contains("gears.rexsz: file = a damaged or encrypted ZIP archive"));
  CHECK_THAT(archive_refusal(archive_of({{"a.rexs", "a"}, {"b.xml", "b"}})), Contains("an archive with 2 models"));
  CHECK_THAT(archive_refusal(archive_of({{"a.txt", "a"}, {"b.txt", "b"}})), Contains("an archive with 0 models"));
  CHECK(archive_refusal(archive_of({{"model", "a"}})).empty());  // the only one there is
  // A few kilobytes that become a tree of gigabytes.
  for (const char* part : {"<a/>", "{},", "0,"}) {
    std::string many = part[0] == '<' ? "<model>" : "{\"model\":[";
    for (int k = 0; k < 2'000'001; ++k) many += part;
    const std::string archive = archive_of({{"a.rexs", many}});
    CHECK(archive.size() < 100'000);
    CHECK_THROWS_WITH(rexs::import_stage(archive, "gears.rexsz", {}), Contains("allowed is at most 2000000 elements and values"));
  }
  // Less than a tenth of a megabyte that becomes more than is unpacked.
  CHECK_THAT(archive_refusal(archive_of({{"a.rexs", std::string(rexs::largest_unpacked + 1, '0')}})), Contains("67108864 bytes unpacked"));
}
