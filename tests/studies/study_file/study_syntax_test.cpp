#include <catch2/catch.hpp>

#include "studies/study_file/study_syntax.hpp"
#include "studies/study_file/study_file.hpp"

using namespace flankwright::studies;
using Catch::Contains;

TEST_CASE("A decimal comma and a unit without quotes are reported as such", "[studies][syntax]") {
  CHECK(syntax_hint("normal_module = 3,25   # mm") == "; decimals stand behind a point: 3.25");
  CHECK(syntax_hint("\tprofile_shift=-0,2") == "; decimals stand behind a point: -0.2");
  CHECK(syntax_hint("face_width = 40 mm\r") == "; a value with its unit is a text in quotes: \"40 mm\"");
  CHECK(syntax_hint("helix_angle = 15°") == "; a value with its unit is a text in quotes: \"15°\"");
}

TEST_CASE("Other lines that are no TOML have no hint", "[studies][syntax]") {
  for (const char* line : {"", "=", "teeth", "teeth =", "teeth = 25,", "teeth = 3..5", "teeth = ,5", "range = [0,5 30]", "name = \"3 mm", "x = 1,2,3",
                           "x = -", "x = .5"}) {
    CAPTURE(line);
    CHECK(syntax_hint(line).empty());
  }
}

TEST_CASE("The hint follows the parser's words", "[studies][syntax]") {
  CHECK_THROWS_WITH(parse_study("[pair]\nnormal_module = 3,5\n", "pump.toml"),
                    Contains("pump.toml:2:") && Contains("decimals stand behind a point: 3.5"));
}
