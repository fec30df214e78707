#include "studies/exchange/grid/grid_table.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/units.hpp"
#include "core/flank/flank.hpp"
#include "core/flank/measured_grid.hpp"
#include "core/flank/natural_twist.hpp"
#include "studies/study_file/grid_file.hpp"
#include "tests/studies/study_texts.hpp"
#include "tests/common/about.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

PairData pair_data() {
  PairData data;
  data.normal_module = 5.0;
  data.helix_angle = 20 * units::deg;
  data.pinion.teeth = 20;
  data.pinion.face_width = 50.0;
  data.wheel.teeth = 43;
  data.wheel.face_width = 48.0;
  return data;
}

}  // namespace

TEST_CASE("A grid for the grinder, read as a measured grid, is the modification", "[studies][grid-table]") {
  const GearPair pair = make_gear_pair(pair_data());
  Modification m;
  m.lead_crowning = 0.012;
  m.lead_slope = -0.005;
  m.tip_relief = {0.015, 1.5, ReliefShape::Parabolic};
  const MeasuredGrid grid = parse_grid(grid_table(pair, Member::Pinion, m, {}, "a\nb").text, "grid.csv");
  REQUIRE(grid.radii.size() == 9);
  REQUIRE(grid.z.size() == 15);
  CHECK(grid.radii.front() == tests::about(pair.pinion.active_root_radius, 1e-6));
  CHECK(grid.radii.back() == tests::about(pair.pinion.tip_radius, 1e-6));
  CHECK(grid.z.back() == 25.0);
  CHECK_NOTHROW(check_coverage(grid, pair.flank_frame(Member::Pinion)));
  const Flank designed = make_flank(pair, Member::Pinion, m, {});
  Modification measured;
  measured.topography = make_grid_field(grid, pair.pinion.base_radius, pair.base_helix_angle).field;
  const Flank read = make_flank(pair, Member::Pinion, measured, {});
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t j = 0; j < 15; ++j) {
      const double rho = designed.roll_at(grid.radii[i]);
      // Half of the last digit written, 1e-4 um, along the transverse base tangent, and radii to 1e-6 mm times the relief's slope.
      CHECK(std::abs(designed.deviation(rho, grid.z[j], 0) - read.deviation(rho, grid.z[j], 0)) < 1.1e-7);
    }
  }
}

TEST_CASE("A grid for the grinder has the natural twist of its process", "[studies][grid-table][grinding]") {
  const GearPair pair = make_gear_pair(pair_data());
  Modification m;
  m.lead_crowning = 0.012;
  for (const GrindingKind kind : {GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding}) {
    m.process.kind = kind;
    const MeasuredGrid grid = parse_grid(grid_table(pair, Member::Wheel, m, {9, 15, 0.0}, "ground").text, "grid.csv");
    const auto slope = [&](Eigen::Index column) { return grid.deviation(0, column) - grid.deviation(8, column); };  // removed is negative
    // Normal to the flank; four times half of the last digit written.
    CHECK(slope(14) - slope(0) == tests::about(std::cos(pair.base_helix_angle) * natural_twist(pair, Member::Wheel, m), 2e-7));
    CHECK(std::abs(slope(14) - slope(0)) > 0.003);
  }
}

TEST_CASE("A grid says how far the surface through it departs from the flank: the less the more points it has", "[studies][grid-table]") {
  const GearPair pair = make_gear_pair(pair_data());
  Modification smooth, kinked;
  smooth.lead_crowning = 0.012;
  kinked.tip_relief = {0.015, 1.5, ReliefShape::Linear};
  constexpr double round_off = 1e-9;
  CHECK(grid_table(pair, Member::Pinion, smooth, {}, "").departure < round_off);  // a spline has parabolas in it
  double before = INFINITY;
  for (const int points : {9, 33, 129}) {
    const double departure = grid_table(pair, Member::Pinion, kinked, {points, 9, 0.0}, "").departure;
    CHECK(departure < 0.5 * before);  // at a kink in proportion to the spacing, a quarter
    before = departure;
  }
  CHECK(before > round_off);
}

TEST_CASE("Points and margin of a grid are as asked for", "[studies][grid-table]") {
  const GearPair pair = make_gear_pair(pair_data());
  const MeasuredGrid grid = parse_grid(grid_table(pair, Member::Wheel, {}, grid_layout("5x7", 0.1), "").text, "grid.csv");
  CHECK(grid.radii.size() == 5);
  REQUIRE(grid.z.size() == 7);
  CHECK(grid.z.front() == Approx(-24.0 + 4.8).epsilon(1e-14));  // round-off
  CHECK(grid.deviation.cwiseAbs().maxCoeff() == 0.0);
  for (const std::string bad : {"", "9", "9x", "x15", "1x15", "9x501", "9x15x3", "-9x15", "9 x 15"})
    CHECK_THROWS_AS(grid_layout(bad, 0.0), InvalidInput);
  CHECK_THROWS_AS(grid_layout("9x15", 0.5), InvalidInput);
}
