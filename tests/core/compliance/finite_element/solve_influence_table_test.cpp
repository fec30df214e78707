#include "core/compliance/finite_element/solve_influence_table.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <thread>

#include "core/base/error.hpp"
#include "core/contact/path/contact_points.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::test;

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

InfluenceTableTask task_of(const GearToMesh& gear, StationGrid grid, const GearMeshOptions& options = coarse()) {
  return {.gear = gear, .teeth_apart = 2, .mesh = options, .grid = std::move(grid)};
}

StationGrid coarse_grid(double width) { return {{-1, -0.3, 0.4, 1}, {0, 0.2 * width, 0.5 * width, 0.8 * width, width}}; }

std::vector<FlankPoint> flank_points(const GearMesh& mesh, const std::vector<FlankStation>& stations) {
  std::vector<FlankPoint> points;
  for (const FlankStation& p : stations) {
    const double radius = mesh.form.form_radius() + (p.u + 1) / 2 * (mesh.form.tip_radius() - mesh.form.form_radius());
    points.push_back({p.tooth, radius, p.zeta * mesh.normal_module - mesh.face_width / 2});
  }
  return points;
}

/// A pair of gears with its common face width in modules.
GearPair pair_of(int pinion, int wheel, double helix_deg, double width) { return pair_cases::pair(pinion, wheel, helix_deg, 1, width); }

}  // namespace

TEST_CASE("A solved table is the gear's influence matrix at the stations of its grid", "[core][compliance][fe]") {
  const double module = 3, modulus = 206000;
  const GearToMesh gear = gear_of(14, 20, 3, 0, module);
  const StationGrid grid = coarse_grid(3);
  std::vector<int> steps;
  const InfluenceTableRun run = solve_influence_table(task_of(gear, grid), kNoLimit, [&](int done, int total) {
    CHECK(total == kTableSteps);
    steps.push_back(done);
  });
  REQUIRE(run.status == FactorStatus::Factorised);
  CHECK(steps.front() == 0);
  CHECK(std::ranges::is_sorted(steps));
  CHECK(std::ranges::adjacent_find(steps) == steps.end());
  CHECK(steps.back() == kTableSteps);

  GearMeshOptions options = coarse();
  options.teeth_each_side = 2;
  const InfluenceModel model(gear, {modulus, 0.3}, options);
  std::vector<FlankStation> stations;
  for (int tooth = -2; tooth <= 2; ++tooth) {
    for (const FlankStation& p : grid.stations(tooth)) stations.push_back(p);
  }
  const Eigen::MatrixXd direct = modulus * module * model.influence(flank_points(model.mesh(), stations)).compliance;
  const Eigen::Index n = grid.size();
  const double scale = direct.maxCoeff();
  for (int m = 0; m <= 2; ++m) {
    const Eigen::MatrixXd forward = direct.block(2 * n, (2 + m) * n, n, n);
    const Eigen::MatrixXd backward = direct.block((2 - m) * n, 2 * n, n, n);
    Eigen::MatrixXd table = run.table->tables()[static_cast<std::size_t>(m)];
    if (m == 0) table.diagonal() /= 1 + run.table->projection().added;
    CHECK((table - 0.5 * (forward + backward)).cwiseAbs().maxCoeff() < 1e-9 * scale);  // round-off x condition
  }
}

TEST_CASE("Neighbours that are read at fewer stations give the same tables", "[core][compliance][fe]") {
  const double width = 6;
  InfluenceTableTask task = task_of(gear_of(20, 30, width), station_grid(width));
  task.root_stress = true;
  const InfluenceTableRun whole = solve_influence_table(task, kNoLimit);
  task.neighbour_grid = neighbour_grid(width);
  REQUIRE(10 * task.neighbour_grid->size() < 6 * task.grid.size());
  const InfluenceTableRun fewer = solve_influence_table(task, kNoLimit);
  const std::vector<Eigen::MatrixXd>&all = whole.table->tables(), &interpolated = fewer.table->tables();
  const Eigen::VectorXd scale = all[0].diagonal().cwiseSqrt().cwiseInverse();
  // The loaded tooth itself is not interpolated: round-off x condition, and what is added for a negative eigenvalue.
  const double added = fewer.table->projection().added;
  CHECK(added < 1e-4);
  CHECK((scale.asDiagonal() * (interpolated[0] - all[0]) * scale.asDiagonal()).cwiseAbs().maxCoeff() < added + 1e-9);
  for (std::size_t m = 1; m < all.size(); ++m) {
    CHECK((scale.asDiagonal() * (interpolated[m] - all[m]) * scale.asDiagonal()).cwiseAbs().maxCoeff() < 1e-3);  // discretisation
  }
  const std::vector<Eigen::MatrixXd>&stress = whole.root_stress->stress, &by_fewer = fewer.root_stress->stress;
  const double largest = stress[2].cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < stress.size(); ++i) CHECK((by_fewer[i] - stress[i]).cwiseAbs().maxCoeff() < 1e-3 * largest);  // likewise
  CHECK(fewer.statistics.peak_bytes < whole.statistics.peak_bytes);
}

TEST_CASE("The same gear gives the same table again, whatever else is being solved", "[core][compliance][fe][slow]") {
  const InfluenceTableTask task = task_of(gear_of(19, 20, 3), coarse_grid(3));
  const InfluenceTableTask other = task_of(gear_of(27, 20, 3), coarse_grid(3));
  const auto tables = [](const InfluenceTableTask& t) { return solve_influence_table(t, kNoLimit).table->tables(); };
  const auto alone = tables(task), others_alone = tables(other);
  // A BLAS without locks spoils about every fourth pair.
  for (int round = 0; round < 8; ++round) {
    std::vector<Eigen::MatrixXd> beside, others;
    std::thread second([&] { others = tables(other); });
    beside = tables(task);
    second.join();
    CHECK(alone == beside);
    CHECK(others_alone == others);
  }
}

TEST_CASE("Gears that differ in size only have the same task in modules", "[core][compliance][fe]") {
  GearToMesh large = gear_of(14, 20, 4, 0, 8);
  large.gear.tip_diameter = 8 * 16.5;
  large.body = {8 * 10.0, 8 * 2.0, 8 * 5.0};
  const GearToMesh small = in_modules(task_of(large, coarse_grid(4))).gear;
  CHECK(small.normal_module == 1);
  CHECK(small.gear.face_width == 4);
  CHECK(small.gear.tip_diameter == 16.5);
  CHECK(small.body.shaft_diameter == 10);
  CHECK(small.body.bore_diameter == 2);
  CHECK(small.body.shaft_overhang == 5);
}

TEST_CASE("A run that does not fit into memory says what it needs, and a grid must fit the face", "[core][compliance][fe]") {
  const InfluenceTableTask task = task_of(gear_of(14, 20, 3), coarse_grid(3));
  const InfluenceTableRun run = solve_influence_table(task, 1e6);
  CHECK(run.status == FactorStatus::OutOfMemory);
  CHECK(!run.table);
  CHECK(run.statistics.unknowns > 1000);
  CHECK(run.statistics.peak_bytes > 1e6);
  CHECK(std::isnan(run.statistics.solve_seconds));
  CHECK_THROWS_AS(solve_influence_table(task_of(gear_of(14, 20, 3), coarse_grid(3.1)), kNoLimit), InvalidInput);
}

TEST_CASE("No two contact points of a mesh position lie further apart than said", "[core][compliance][fe]") {
  const auto [helix, width] = GENERATE(std::pair{0.0, 8.0}, std::pair{15.0, 6.0}, std::pair{30.0, 12.0}, std::pair{40.0, 20.0});
  const GearPair pair = pair_of(20, 33, helix, width);
  const PathOfContact path(pair);
  int most = 0;
  for (int i = 0; i < 200; ++i) {
    const auto points = contact_points(pair, path, {QuadratureRule::Gauss3, 40}, i / 200.0, true, -width / 2, width / 2);
    const auto [first, last] = std::ranges::minmax(points, {}, [](const ContactPoint& point) { return point.tooth; });
    most = std::max(most, last.tooth - first.tooth);
  }
  CAPTURE(helix, width);
  CHECK(most == teeth_apart_in_contact(pair));
}

TEST_CASE("Influence between grid stations is near the finite elements' own", "[.soak][core][compliance][fe]") {
  const int teeth = GENERATE(18, 40);
  const double width = 12;
  const GearToMesh gear = gear_of(teeth, 30, width);
  const InfluenceTableRun run = solve_influence_table(task_of(gear, station_grid(width), {}), kNoLimit);
  REQUIRE(run.table);
  CHECK(run.table->projection().added < 1e-12);  // round-off: steps near the ends are finer than the elements

  const InfluenceModel model(gear, {1, 0.3});
  std::vector<FlankStation> unseen;
  for (const int tooth : {0, 1, 2, -1, -2}) {
    for (const double u : {-0.9, -0.5, -0.15, 0.3, 0.75, 0.97}) {
      for (const double zeta : {0.08, 0.3, 0.57, 1.0, 1.6, 2.3, 3.1, 4.8, 6.3, 8.0, 9.9, 10.5, 11.1, 11.45, 11.72, 11.93}) {
        unseen.push_back({tooth, u, zeta});
      }
    }
  }
  const Eigen::MatrixXd direct = model.influence(flank_points(model.mesh(), unseen)).compliance;
  const Eigen::Index n = std::ssize(unseen) / 5;
  const Eigen::MatrixXd ours = run.table->evaluate({unseen.data(), static_cast<std::size_t>(3 * n)});
  for (int m = 0; m <= 2; ++m) {
    // The mean of two reciprocal pairs, as the table has it: what is left is interpolation.
    const Eigen::Index before = m == 0 ? 0 : m + 2;
    const Eigen::ArrayXXd theirs = 0.5 * (direct.block(0, m * n, n, n) + direct.block(before * n, 0, n, n)).array();
    Eigen::ArrayXXd error = ((ours.block(0, m * n, n, n).array() - theirs) / theirs).abs();
    std::vector<double> sorted(error.data(), error.data() + error.size());
    std::ranges::sort(sorted);
    const double median = sorted[sorted.size() / 2], share_95 = sorted[sorted.size() * 95 / 100], worst = sorted.back();
    CAPTURE(teeth, m, median, share_95, worst);
    // Discretisation. The worst are own values at the tip, where the finite elements' own values waver by as much with
    // the place of the load in its element.
    CHECK(median < 0.001);
    CHECK(share_95 < 0.005);
    CHECK(worst < 0.08);
  }
}
