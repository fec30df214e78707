#include "studies/study_file/key_page.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>

#include "studies/study_file/study_schema.hpp"

using namespace flankwright::studies;

namespace {

/// Lines of the page that begin with a key: "| `pinion.teeth` |".
int rows_of(const std::string& page, const std::string& key) {
  const std::string start = "\n| `" + key + "` | ";
  int count = 0;
  for (std::size_t at = page.find(start); at != std::string::npos; at = page.find(start, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("The committed key reference is what the schema gives", "[studies][readme]") {
  std::ifstream file(FLANKWRIGHT_SOURCE_DIR "/studies/keys.md");
  REQUIRE(file);
  std::ostringstream committed;
  committed << file.rdbuf();
  INFO("flankwright keys > studies/keys.md writes the page anew");
  CHECK(committed.str() == key_page());
}

TEST_CASE("The key reference has every key once, a wheel's under its own name only where it differs from the pinion's", "[studies][readme]") {
  const std::string page = key_page();
  for (const SchemaKey& key : study_schema()) {
    CAPTURE(key.path);
    const bool of_wheel = key.path.starts_with("wheel.");
    const int own = rows_of(page, key.path);
    if (!of_wheel) CHECK(own == 1);
    if (of_wheel && own == 0) CHECK(rows_of(page, "pinion." + key.path.substr(6)) == 1);
    CHECK(own <= 1);
  }
  CHECK(rows_of(page, "wheel.hand") == 1);   // by default the opposite of the pinion's
  CHECK(rows_of(page, "wheel.teeth") == 0);  // as the pinion's
}
