#include "studies/study_file/grid_file.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/thread_stopwatch.hpp"
#include "core/base/units.hpp"
#include "core/flank/measured_grid.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/common/random.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

const std::string header = "radius_mm,z_mm,deviation_um\n";

/// What is said about a file that is refused.
std::string refusal(const std::string& text) {
  try {
    parse_grid(text, "flank.csv");
  } catch (const StudyErrors& errors) {
    return errors.what();
  }
  return "";
}

void check_small(const MeasuredGrid& grid) {
  CHECK(grid.radii == std::vector<double>{50.0, 52.5});
  CHECK(grid.z == std::vector<double>{-10.0, 0.0, 10.0});
  REQUIRE(grid.deviation.rows() == 2);
  REQUIRE(grid.deviation.cols() == 3);
  constexpr double round_off = 1e-18;  // um to mm
  const std::array<double, 6> um{-1.0, 0.0, 2.0, 3.5, 4.0, -50.0};
  for (int i = 0; i < 6; ++i) CHECK(std::abs(grid.deviation(i / 3, i % 3) - 1e-3 * um[static_cast<std::size_t>(i)]) <= round_off);
}

const std::vector<std::string> small_rows{"50,-10,-1", "50,0,0", "50,10,2", "52.5,-10,3.5", "52.5,0,4", "52.5,10,-50"};

std::string joined(const std::vector<std::string>& rows) {
  std::string text;
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

}  // namespace

TEST_CASE("A grid file is read whatever its order, separator, comments and line ends", "[studies][grid-file]") {
  check_small(parse_grid(header + joined(small_rows), "a"));
  check_small(
      parse_grid("\xef\xbb\xbf# a flank\r\n\r\n deviation_um ; radius_mm ; z_mm\r\n"
                 "-1;50;-10\r\n 0;50;0\r\n2;50;1e1 # at the end\r\n\r\n+3.5;52.5;-10\r\n4;52.50;0\r\n-50;5.25e1;10",
                 "b"));
  check_small(
      parse_grid("z_mm\tradius_mm\tdeviation_um\n-10\t50\t-1\n0\t50\t0\n10\t50\t2\n"
                 "-10\t52.5\t3.5\n0\t52.5\t4\n  \n10\t52.5\t-50\n",
                 "c"));
}

TEST_CASE("Tables of measuring programs and spreadsheets are read as they are", "[studies][grid-file]") {
  const std::string rows =
      "50,0;-10,0;-1,0\n50;0;0\n50;10;2\n52,5;-10;3,5\n52,5;0;4\n52,5;10;\xe2\x88\x92"
      "50\n";
  // Decimal comma with semicolons; names and units however they are written.
  check_small(parse_grid("Radius [mm];Z (mm);Abweichung/\xc2\xb5m\n" + rows, "a"));
  check_small(parse_grid("sep=;\r\nr;z;dev\r\nmm;mm;\xc2\xb5m\r\n" + rows, "b"));
  check_small(parse_grid("% exported\n// twice\nr;z;dev\n" + rows, "c"));
  // Quoted cells with commas inside.
  check_small(
      parse_grid("\"radius_mm\",\"z_mm\",\"deviation_um\"\n\"50,0\",-10,-1\n50,0,0\n50,10,2\n\"52,5\",-10,\"3,5\"\n52.5,0,4\n52.5,10,-50\n", "d"));
  // Diameters, other units, removal instead of metal added, lines of an old Macintosh.
  check_small(parse_grid("d;z;removal_mm\r100;-10;0,001\r100;0;0\r100;10;-0,002\r105;-10;-0,0035\r105;0;-0,004\r105;10;0,05", "e"));
  const double inch = 25.4;
  const MeasuredGrid inches = parse_grid("radius_in,z_in,deviation_mil\n2,0,1\n2,1,0\n3,0,0\n3,1,0\n", "f");
  CHECK(inches.radii == std::vector{2.0 * inch, 3.0 * inch});
  CHECK(std::abs(inches.deviation(0, 0) - 1e-3 * inch) < 1e-17);
}

TEST_CASE("The order of the rows changes no bit", "[studies][grid-file][determinism]") {
  std::vector<std::string> rows = small_rows;
  rows[1] = "50,-0,-0";
  const MeasuredGrid grid = parse_grid(header + joined(rows), "a");
  tests::Random random(5);
  for (int run = 0; run < 10; ++run) {
    random.shuffle(rows);
    const MeasuredGrid other = parse_grid(header + joined(rows), "a");
    CHECK(other.radii == grid.radii);
    CHECK(other.z == grid.z);
    CHECK(!std::signbit(other.z[1]));
    CHECK(other.deviation == grid.deviation);
  }
}

TEST_CASE("A mistake in a grid file is reported in one line with its position", "[studies][grid-file][errors]") {
  const std::string names = "allowed is once each, radius_mm (or diameter_mm), z_mm, deviation_um (or removal_um)";
  const std::string number = "allowed is a number -1000 .. 1000";
  CHECK(refusal("") == "flank.csv: file = without content: allowed is a line of column names, then a line for each point");
  CHECK(refusal("# only this\n") == refusal(""));
  CHECK(refusal("radius_mm,y,deviation_um\n") == "flank.csv:1:11: column = y: " + names);
  CHECK(refusal("radius_mm,z_kg,deviation_um\n") == "flank.csv:1:11: column = z_kg: " + names);
  CHECK(refusal("\nradius_mm,z_mm,z_mm\n") == "flank.csv:2:16: column = z_mm: " + names);
  CHECK(refusal("radius_mm,z_mm\n") == "flank.csv:1:1: columns = radius_mm,z_mm: " + names);
  CHECK(refusal("50,-10,-1\n") == "flank.csv:1:1: column = 50: " + names);
  CHECK(refusal(header + "50,-10\n") ==
        "flank.csv:2:1: line = 50,-10: allowed is 3 numbers with the separator of the first line (a comma, so no decimal commas)");
  CHECK(refusal(header + "50,-10,1,\n") ==
        "flank.csv:2:1: line = 50,-10,1,: allowed is 3 numbers with the separator of the first line (a comma, so no decimal commas)");
  for (const std::string bad : {"", "nan", "inf", "-inf", "3 um", "1e999", "0x3", "--3", "+-3", "1001", "-1e6"}) {
    CHECK(refusal(header + "50,-10,2\n50,0, " + bad + "\n") == "flank.csv:3:7: deviation = " + bad + ": " + number);
  }
  CHECK(refusal("radius_mm;z_mm;deviation_um\n50;-10;1.000,5\n") == "flank.csv:2:8: deviation = 1.000,5: " + number);
  CHECK(refusal("radius_mm;z_mm;deviation_um\n50;-10;1,5,5\n") == "flank.csv:2:8: deviation = 1,5,5: " + number);
  CHECK(refusal(header + "50,5,-10,1,5\n") ==
        "flank.csv:2:1: line = 50,5,-10,1,5: allowed is 3 numbers with the separator of the first line (a comma, so no decimal commas)");
  CHECK(refusal("\xff\xfer\0") == "flank.csv:1:1: file = in UTF-16: allowed is a text in UTF-8");
  CHECK(refusal(header + "mm,mm,um\n") == "flank.csv:2:1: unit = mm: allowed is one unit: the header has it already");
  CHECK(refusal(header + "5e4,-10,1\n") == "flank.csv:2:1: radius = 5e4: allowed is a number -10000 .. 10000");
  CHECK(refusal("deviation_um,z_mm,diameter_mm\n1,0,5e4\n") == "flank.csv:2:5: radius = 5e4: allowed is a number -20000 .. 20000");
  CHECK(refusal("deviation_um,z_mm,radius_mm\n2e3,0,50\n") == "flank.csv:2:1: deviation = 2e3: " + number);
  CHECK(refusal(header + joined(small_rows) + "50,0,0\n") ==
        "flank.csv:8:1: point = radius_mm 50, z_mm 0: allowed is each point once; line 3 has this one");
  CHECK(refusal(header) == "flank.csv: grid = 0 radii with 0 axial positions: allowed is at least 2 x 2");
  CHECK(refusal(header + "50,0,0\n50,1,0\n") == "flank.csv: grid = 1 radii with 2 axial positions: allowed is at least 2 x 2");
  CHECK(refusal(header + std::string(500, 'x') + "\n").size() < 200);
}

TEST_CASE("A control character in a grid file is shown by its number", "[studies][grid-file][errors]") {
  const std::string nul("50,0,1\0002", 8);
  CHECK(refusal(header + nul + "\n") == "flank.csv:2:6: deviation = 1\\x002: allowed is a number -1000 .. 1000");
  CHECK(refusal(header + "50,0,\x1b[31m\n") == "flank.csv:2:6: deviation = \\x1b[31m: allowed is a number -1000 .. 1000");
}

TEST_CASE("A grid beyond the limits is refused when they are passed, and time grows with the lines alone", "[studies][grid-file][errors]") {
  const auto square = [](int lines) {
    std::string text = header;
    for (int i = 0; i < lines; ++i) {
      for (int j = 0; j < lines; ++j) text += std::to_string(50.0 + 0.01 * i) + "," + std::to_string(0.1 * j) + ",1\n";
    }
    return text;
  };
  CHECK_THAT(refusal(square(501)),
             Catch::Contains(":250002:1: grid = more than 250000 points: allowed is at most 500 radii with 500 axial positions"));
  std::string wide = header;
  for (int j = 0; j <= 500; ++j) {
    for (const char* radius : {"50", "51"}) wide += std::string(radius) + "," + std::to_string(j) + ",1\n";
  }
  CHECK(refusal(wide) == "flank.csv: grid = 2 radii with 501 axial positions: allowed is at most 500 of each");
  const auto seconds = [](const std::string& text) {
    double least = 1e9;
    for (int run = 0; run < 3; ++run) {
      const ThreadStopwatch clock;
      parse_grid(text, "flank.csv");
      least = std::min(least, clock.seconds());
    }
    return least;
  };
  // Sixteen times the lines: sixteen times the work and a little for sorting; the square of it would be 256.
  CHECK(seconds(square(400)) < 64.0 * seconds(square(100)));
}

TEST_CASE("A point that is missing is named, wherever it is", "[studies][grid-file][errors]") {
  const std::array<std::string, 6> missing{"radius_mm 50, z_mm -10",   "radius_mm 50, z_mm 0",   "radius_mm 50, z_mm 10",
                                           "radius_mm 52.5, z_mm -10", "radius_mm 52.5, z_mm 0", "radius_mm 52.5, z_mm 10"};
  for (std::size_t i = 0; i < missing.size(); ++i) {
    std::vector<std::string> rows = small_rows;
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(i));
    CHECK_THAT(refusal(header + joined(rows)), Catch::Contains(": point = none at " + missing[i] + ": allowed is every radius"));
  }
  // A radius that is not written alike is one more radius.
  std::vector<std::string> rows = small_rows;
  rows[1] = "50.001,0,0";
  CHECK_THAT(refusal(header + joined(rows)), Catch::StartsWith("flank.csv:2:1: point = none at radius_mm 50, z_mm 0:"));
}

TEST_CASE("A grid file that cannot be read is one clear line", "[studies][grid-file][errors]") {
  CHECK_THROWS_WITH(read_grid("no/such/grid.csv"), "no/such/grid.csv: the file cannot be read");
  CHECK_THROWS_WITH(read_grid(std::filesystem::temp_directory_path().string()), Catch::EndsWith(": the file cannot be read"));
}

TEST_CASE("No damage to a grid file makes the reader fail otherwise than with errors", "[studies][grid-file][fuzz]") {
  tests::Random32 random(20261121);
  const std::vector<std::string> pieces{",", ";", "\t", "\n", "\r", "#", "-", "1e308", "nan", "0", "\xef\xbb\xbf", "\xc3", "z_mm"};
  int valid = 0;
  for (int run = 0; run < 3000; ++run) {
    std::string text = header + joined(small_rows);
    for (std::size_t changes = random.below(4); changes > 0; --changes) {
      text.replace(random.below(text.size()), random.below(3), random.one_of(pieces));
    }
    try {
      const MeasuredGrid grid = parse_grid(text, "mutated.csv");
      CHECK_NOTHROW(validate(grid, -2.0 * largest_grid_length));
      ++valid;
    } catch (const StudyErrors& errors) {
      CHECK(errors.problems().size() == 1);
    }
  }
  CHECK(valid > 0);
  CHECK(valid < 3000);
}

TEST_CASE("The example grids agree with their formulas", "[studies][grid-file][examples]") {
  const auto beyond = [](double x, double start) { return std::pow(std::max(0.0, x / start - 1.0), 2); };
  const auto longitudinal = [&](double, double z) { return -50.0 * beyond(std::abs(z), 23.0); };
  const auto three_dimensional = [&](double r, double z) { return -25.0 * (beyond(std::abs(z), 23.0) + beyond(std::abs(r - 57.20165), 2.406775)); };
  const auto one_sided = [](double, double z) { return -50.0 * std::pow((z + 23.0) / 69.0, 2); };
  const auto check = [](const std::string& name, const auto& formula) {
    const MeasuredGrid grid = read_grid(FLANKWRIGHT_SOURCE_DIR "/studies/examples/grids/17-44-" + name + ".csv");
    CAPTURE(name);
    REQUIRE(grid.radii.size() == 9);
    REQUIRE(grid.z.size() == 15);
    constexpr double written = 0.5001e-4 * units::um;  // four decimals of a micrometre
    for (int k = 0; k < 135; ++k) {
      const double r = grid.radii[static_cast<std::size_t>(k / 15)], z = grid.z[static_cast<std::size_t>(k % 15)];
      CHECK(std::abs(grid.deviation(k / 15, k % 15) - formula(r, z) * units::um) <= written);
    }
  };
  check("longitudinal", longitudinal);
  check("three-dimensional", three_dimensional);
  check("one-sided-helix", one_sided);
}
