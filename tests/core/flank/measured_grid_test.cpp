#include "core/flank/measured_grid.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/flank/flank.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/common/random.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using units::deg;
using units::um;

namespace {

constexpr double grid_round_off = 1e-14;  // mm, on deviations of some 0.05 mm

/// The pair of "TCA of real helical gears", table 1.
GearPair real_pair() { return pair_cases::pair(17, 44, 24.43, 6.0, 92.0); }

/// Normal deviation [mm, + = metal added] at radius and z.
using Deviation = std::function<double(double, double)>;

/// The paper's 9 x 15 points, even over height and width, short of the pinion's borders by a twentieth of either.
MeasuredGrid paper_grid(const GearPair& pair, const Deviation& deviation) {
  const FlankFrame frame = pair.flank_frame(Member::Pinion);
  const double height = frame.tip_radius - frame.active_root_radius;
  MeasuredGrid grid;
  for (int i = 0; i < 9; ++i) grid.radii.push_back(frame.active_root_radius + height * (0.05 + 0.9 * i / 8.0));
  for (int j = 0; j < 15; ++j) grid.z.push_back(frame.face_width * (-0.45 + 0.9 * j / 14.0));
  grid.deviation.resize(9, 15);
  for (Eigen::Index i = 0; i < 9; ++i) {
    for (Eigen::Index j = 0; j < 15; ++j) {
      grid.deviation(i, j) = deviation(grid.radii[static_cast<std::size_t>(i)], grid.z[static_cast<std::size_t>(j)]);
    }
  }
  return grid;
}

GridFit fit_on(const GearPair& pair, const MeasuredGrid& grid, const GridFitOptions& options = {}) {
  return make_grid_field(grid, pair.pinion.base_radius, pair.base_helix_angle, options);
}

/// Largest difference between the field and a normal deviation, on a fine net [mm, normal]: `beyond` spreads the net
/// from the grid's own borders (0) to those of the active flank (1).
double largest_error(const GearPair& pair, const MeasuredGrid& grid, const DeviationField& field, const Deviation& truth, double beyond) {
  const FlankFrame frame = pair.flank_frame(Member::Pinion);
  const double low = std::lerp(grid.radii.front(), frame.active_root_radius, beyond);
  const double high = std::lerp(grid.radii.back(), frame.tip_radius, beyond);
  const double half = std::lerp(grid.z.back(), 0.5 * frame.face_width, beyond);
  double largest = 0.0;
  for (int i = 0; i <= 100; ++i) {
    for (int j = 0; j <= 100; ++j) {
      const double r = std::lerp(low, high, i / 100.0), z = std::lerp(-half, half, j / 100.0);
      const double normal = -std::cos(pair.base_helix_angle) * field.at(pair.pinion.roll_length_at(r), z).value;
      largest = std::max(largest, std::abs(normal - truth(r, z)));
    }
  }
  return largest;
}

/// 50 um from highest to lowest: crowned along the lead, wavy along the profile, twisted.
double smooth_deviation(const GearPair& pair, double r, double z) {
  const FlankFrame frame = pair.flank_frame(Member::Pinion);
  const double x = 2.0 * z / frame.face_width;
  const double y = (r - frame.active_root_radius) / (frame.tip_radius - frame.active_root_radius);
  return (-35.0 * x * x + 13.0 * std::sin(4.0 * y + x) + 10.0 * x * y) * um;
}

std::string grid_refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& problem) {
    return problem.field() + ": " + problem.value();
  }
  return "";
}

/// A valid 3 x 2 grid above a base radius of 50 mm.
MeasuredGrid small_grid() {
  MeasuredGrid grid{{51.0, 52.0, 54.0}, {-5.0, 5.0}, Eigen::MatrixXd(3, 2)};
  grid.deviation << 0.001, 0.002, 0.003, 0.004, 0.005, 0.006;
  return grid;
}

}  // namespace

TEST_CASE("Added metal moves the flank along its normal by the deviation measured", "[core][flank][grid]") {
  const GearPair pair = real_pair();
  const double added = GENERATE(0.02, -0.05);
  Modification m;
  m.topography = fit_on(pair, paper_grid(pair, [&](double, double) { return added; })).field;
  const Flank nominal = make_flank(pair, Member::Pinion, {}, {}), real = make_flank(pair, Member::Pinion, m, {});
  for (const double rho : {12.0, 20.0, 31.0}) {
    for (const double z : {-40.0, 3.0, 45.0}) {
      const SurfacePoint a = surface_point(nominal, rho, z, 0, 0.0), b = surface_point(real, rho, z, 0, 0.0);
      // Model: the tangential part of the displacement, added tan(beta_b), leaves the tangent plane by its square over
      // the curvature.
      CHECK((b.position - a.position).dot(a.normal) == tests::about(added, added * added / rho));
    }
  }
}

TEST_CASE("A grid of a lead crowning is that lead crowning, beyond the grid to the end of its fading curvature", "[core][flank][grid][closed-form]") {
  const GearPair pair = real_pair();
  const FlankFrame frame = pair.flank_frame(Member::Pinion);
  Modification crowned;
  crowned.lead_crowning = 0.03;
  crowned.lead_slope = -0.01;
  const Deviation measured = [&](double r, double z) { return -std::cos(pair.base_helix_angle) * removal(crowned, frame, r, z); };
  const MeasuredGrid grid = paper_grid(pair, measured);
  const GridFit fit = fit_on(pair, grid);
  for (double rho = 8.0; rho < 33.0; rho += 2.7) {
    for (double z = grid.z.front(); z <= grid.z.back(); z += 3.1) {
      const Jet d = fit.field->at(rho, z);
      const double r = std::hypot(rho, pair.pinion.base_radius);
      CHECK(std::abs(d.value - removal(crowned, frame, r, z)) <= grid_round_off);
      CHECK(std::abs(d.v - (8.0 * 0.03 * z / 92.0 - 0.01) / 92.0) <= grid_round_off);
      CHECK(std::abs(d.vv - 8.0 * 0.03 / (92.0 * 92.0)) <= grid_round_off);
      CHECK(std::abs(d.u) + std::abs(d.uu) + std::abs(d.uv) <= grid_round_off);
    }
  }
  // Model: the share d/(3 L) of the curvature term at the face end, d = 4.6 mm beyond the grid, L = 82.8/14 mm.
  const double missing = 4.6 / (3.0 * 82.8 / 14.0) * 0.5 * 8.0 * 0.03 * (4.6 / 92.0) * (4.6 / 92.0);
  CHECK(fit.field->at(20.0, 46.0).value == tests::about(removal(crowned, frame, 60.0, 46.0) - missing, grid_round_off));
}

TEST_CASE("A deviation that is bilinear in roll length and z comes back exactly from an uneven 2 x 2 grid", "[core][flank][grid][closed-form]") {
  const double rb = 40.0, beta_b = 0.4;
  MeasuredGrid grid{{41.0, 50.0}, {-7.0, 20.0}, Eigen::MatrixXd(2, 2)};
  const auto truth = [](const Jet& rho, const Jet& z) { return 1e-3 * (2.0 - 0.3 * rho + 0.2 * z + 0.05 * rho * z); };
  for (Eigen::Index i : {0, 1}) {
    for (Eigen::Index j : {0, 1}) {
      const double r = grid.radii[static_cast<std::size_t>(i)];
      grid.deviation(i, j) = -std::cos(beta_b) * truth(std::sqrt(r * r - rb * rb), grid.z[static_cast<std::size_t>(j)]).value;
    }
  }
  const GridFit fit = make_grid_field(grid, rb, beta_b);
  for (const double rho : {5.0, 20.0, 40.0}) {
    for (const double z : {-30.0, 1.0, 25.0}) {
      const Jet error = fit.field->at(rho, z) - truth(Jet::variable_u(rho), Jet::variable_v(z));
      CHECK(std::abs(error.value) <= 10.0 * grid_round_off);
      CHECK(std::abs(error.u) + std::abs(error.v) + std::abs(error.uv) <= 10.0 * grid_round_off);
      CHECK(std::abs(error.uu) + std::abs(error.vv) <= 10.0 * grid_round_off);
    }
  }
}

TEST_CASE("The 9 x 15 grid of a smooth deviation of 50 um is within 1 um between its points, and to the borders of the flank",
          "[core][flank][grid][published]") {
  // "TCA of real helical gears": "for helical gears with deviations up to 50 microns, the fitting accuracy is within 1
  // micron".
  const GearPair pair = real_pair();
  const Deviation truth = [&](double r, double z) { return smooth_deviation(pair, r, z); };
  const MeasuredGrid grid = paper_grid(pair, truth);
  REQUIRE(grid.deviation.maxCoeff() - grid.deviation.minCoeff() == Approx(50.0 * um).epsilon(0.05));
  const GridFit fit = fit_on(pair, grid);
  const double inside = largest_error(pair, grid, *fit.field, truth, 0.0);
  const double everywhere = largest_error(pair, grid, *fit.field, truth, 1.0);
  CAPTURE(inside / um, everywhere / um);
  CHECK(inside <= 1.0 * um);
  CHECK(everywhere <= 1.0 * um);
  CHECK(fit.largest <= grid_round_off);
}

TEST_CASE("A grid without deviation is the involute itself", "[core][flank][grid]") {
  const GearPair pair = real_pair();
  const GridFit fit = fit_on(pair, paper_grid(pair, [](double, double) { return 0.0; }));
  for (const double rho : {1.0, 20.0, 40.0}) {
    const Jet d = fit.field->at(rho, 17.0);
    CHECK(d.value == 0.0);
    CHECK(std::abs(d.u) + std::abs(d.v) + std::abs(d.uu) + std::abs(d.uv) + std::abs(d.vv) == 0.0);
  }
}

TEST_CASE("Fewer pieces smooth noise: the residual is the noise, the surface closer to the truth than through every point",
          "[core][flank][grid][least-squares]") {
  const GearPair pair = real_pair();
  const Deviation truth = [&](double r, double z) { return smooth_deviation(pair, r, z); };
  tests::Random32 random(11);
  MeasuredGrid grid = paper_grid(pair, truth);
  for (double& delta : grid.deviation.reshaped()) delta += um * random.normal();
  const GridFit through = fit_on(pair, grid), smooth = fit_on(pair, grid, {.profile_pieces = 2, .face_pieces = 2});
  // 5 x 5 B-splines take 25 of the 135 degrees of freedom; scatter of a standard deviation from 110 others: 7 %.
  CHECK(smooth.rms == Approx(std::sqrt(110.0 / 135.0) * um).epsilon(0.2));
  CHECK(smooth.largest >= smooth.rms);
  CHECK(through.largest <= grid_round_off);
  // Between the points, and at the borders of the active flank, where the extension magnifies what the edge of the grid
  // says.
  for (const double beyond : {0.0, 1.0}) {
    const double error_smooth = largest_error(pair, grid, *smooth.field, truth, beyond);
    const double error_through = largest_error(pair, grid, *through.field, truth, beyond);
    CAPTURE(beyond, error_smooth / um, error_through / um, smooth.rms / um);
    CHECK(error_smooth <= (beyond > 0.0 ? 0.3 : 0.8) * error_through);
  }
}

TEST_CASE("A grid that is not one is refused, and why is said", "[core][flank][grid][errors]") {
  const auto refused = [](const std::function<void(MeasuredGrid&)>& spoil) {
    MeasuredGrid grid = small_grid();
    spoil(grid);
    return grid_refusal([&] { make_grid_field(grid, 50.0, 0.3); });
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused([](MeasuredGrid&) {}).empty());
  CHECK(refused([](MeasuredGrid& g) { g.radii = {51.0}; }) == "grid: 1 radii");
  CHECK(refused([](MeasuredGrid& g) { g.z = {}; }) == "grid: 0 axial positions");
  CHECK(refused([](MeasuredGrid& g) { g.z.assign(501, 0.0); }) == "grid: 501 axial positions");
  CHECK(refused([](MeasuredGrid& g) { g.z = {5.0, 5.0}; }) == "grid: 5 mm after 5 mm");
  CHECK(refused([](MeasuredGrid& g) { g.z = {5.0, 5.0009}; }) == "grid: 5.0009 mm after 5 mm");
  CHECK(refused([](MeasuredGrid& g) { g.radii[1] = 50.5; }) == "grid: 50.5 mm after 51 mm");
  CHECK(refused([](MeasuredGrid& g) { g.radii[1] = nan; }) == "grid: nan mm among the radii");
  CHECK(refused([](MeasuredGrid& g) { g.z[1] = 1e300; }) == "grid: 1e+300 mm among the axial positions");
  CHECK(refused([](MeasuredGrid& g) { g.radii[0] = 50.0; }) == "grid: radius 50 mm");
  CHECK(refused([](MeasuredGrid& g) { g.deviation.resize(2, 2); }) == "grid: 4 deviations");
  CHECK(refused([](MeasuredGrid& g) { g.deviation(2, 1) = nan; }) == "grid: a deviation of nan mm");
  CHECK(refused([](MeasuredGrid& g) { g.deviation(0, 0) = -1.5; }) == "grid: a deviation of -1.5 mm");
  CHECK_THAT(refused([](MeasuredGrid& g) {
               g.radii[1] = 51.01;
               g.deviation(1, 0) = 0.5;
             }),
             Catch::StartsWith("grid: a change by 0.5223"));  // (0.5 - 0.001)/cos(0.3)
}

TEST_CASE("A grid whose steps differ ten to one still passes through its points", "[core][flank][grid]") {
  MeasuredGrid grid{{50.1, 50.2, 51.2, 52.2, 52.3, 53.3}, {-10.0, -9.0, 0.0, 0.9, 1.8, 10.8}, Eigen::MatrixXd(6, 6)};
  tests::Random32 random(2);
  for (double& delta : grid.deviation.reshaped()) delta = 0.01 * um * static_cast<double>(random.below(100));
  // Round-off of what the spline swings to between points of such noise, up to 1000 times as far.
  CHECK(make_grid_field(grid, 50.0, 0.3).largest <= 1000.0 * grid_round_off);
}

TEST_CASE("The number of pieces is that of the points less three at most", "[core][flank][grid][errors]") {
  const GearPair pair = real_pair();
  const MeasuredGrid grid = paper_grid(pair, [](double, double) { return 0.0; });
  const auto refused = [&](const GridFitOptions& options) { return grid_refusal([&] { fit_on(pair, grid, options); }); };
  CHECK(refused({6, 12}).empty());
  CHECK(refused({7, {}}) == "grid.profile_pieces: 7");
  CHECK(refused({{}, 13}) == "grid.face_pieces: 13");
  CHECK(refused({0, 1}) == "grid.profile_pieces: 0");
}

TEST_CASE("Coverage is the share of the active flank, and a grid of another flank is refused", "[core][flank][grid]") {
  const GearPair pair = real_pair();
  const FlankFrame frame = pair.flank_frame(Member::Pinion);
  const MeasuredGrid grid = paper_grid(pair, [](double, double) { return 0.0; });
  const auto roll = [&](double r) { return pair.pinion.roll_length_at(r); };
  const GridCoverage coverage = check_coverage(grid, frame);
  CHECK(coverage.face == Approx(0.9).epsilon(1e-12));
  CHECK(coverage.profile ==
        Approx((roll(grid.radii.back()) - roll(grid.radii.front())) / (roll(frame.tip_radius) - roll(frame.active_root_radius))).epsilon(1e-12));

  MeasuredGrid all = grid;
  all.radii.front() = frame.active_root_radius - 0.1;
  all.radii.back() = frame.tip_radius + 1.0;
  all.z.back() = 60.0;
  CHECK(check_coverage(all, frame).profile == 1.0);
  CHECK(check_coverage(all, frame).face == Approx(0.95).epsilon(1e-12));

  MeasuredGrid from_face_end = grid, below_face_end = grid, diameters = grid;
  for (double& z : from_face_end.z) z += 46.0;
  for (double& z : below_face_end.z) z -= 46.0;
  for (double& r : diameters.radii) r *= 2.0;
  CHECK_THAT(grid_refusal([&] { check_coverage(from_face_end, frame); }), Catch::StartsWith("grid: z 4.6 mm .. 87.4 mm"));
  CHECK_THAT(grid_refusal([&] { check_coverage(below_face_end, frame); }), Catch::StartsWith("grid: z -87.4 mm .. -4.6 mm"));
  CHECK_THAT(grid_refusal([&] { check_coverage(diameters, frame); }), Catch::StartsWith("grid: radii 105.7"));
}
