#include "core/compliance/finite_element/influence_table.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "tests/reference/eigenvalues.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

StationGrid small_grid() { return {{-1, -0.3, 0.4, 1}, {0, 0.5, 1.5, 2.5, 3}}; }

/// A stationary kernel of places and teeth, positive definite in all of them (Bochner): tables that need no repair.
double kernel(const FlankStation& p, const FlankStation& q) {
  const double square = (p.u - q.u) * (p.u - q.u) + std::pow(p.zeta - q.zeta + 0.4 * (p.tooth - q.tooth), 2);
  return (1.5 + 0.3 * p.u) * (1.5 + 0.3 * q.u) * std::exp(-0.5 * square - 0.7 * std::abs(p.tooth - q.tooth));
}

std::vector<Eigen::MatrixXd> kernel_tables(const StationGrid& grid, int teeth_apart) {
  std::vector<Eigen::MatrixXd> tables;
  for (int m = 0; m <= teeth_apart; ++m) {
    const auto rows = grid.stations(0), columns = grid.stations(m);
    Eigen::MatrixXd table(grid.size(), grid.size());
    for (Eigen::Index i = 0; i < grid.size(); ++i) {
      for (Eigen::Index j = 0; j < grid.size(); ++j) {
        table(i, j) = kernel(rows[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(j)]);
      }
    }
    tables.push_back(table);
  }
  return tables;
}

double lowest_over_highest(const Eigen::MatrixXd& k) {
  const Eigen::VectorXd values = symmetric_eigenvalues(k);
  return values[0] / values[values.size() - 1];
}

const std::vector<FlankStation> kScattered{{4, -0.9, 0.1}, {3, 0.2, 2.9}, {4, 1, 3},     {3, -1, 1.1}, {5, 0.7, 0},
                                           {5, 0.1, 1.7},  {4, 0, 1.4},   {3, 0.5, 0.2}, {5, -0.5, 2}, {4, 0, 1.45}};

}  // namespace

TEST_CASE("At stations of its grid an influence table gives its tables, on any tooth and in both directions", "[core][compliance][fe]") {
  const StationGrid grid = small_grid();
  const std::vector<Eigen::MatrixXd> tables = kernel_tables(grid, 2);
  const InfluenceTable table(grid, tables);
  CHECK(table.projection().added == 0);
  CHECK(table.projection().lowest_eigenvalue > 0);
  std::vector<FlankStation> stations;
  for (const int tooth : {7, 5, 6}) {
    for (const FlankStation& p : grid.stations(tooth)) stations.push_back(p);
  }
  const Eigen::MatrixXd k = table.evaluate(stations);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    for (std::size_t j = 0; j < stations.size(); ++j) {
      CHECK(k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) ==
            Approx(kernel(stations[i], stations[j])).epsilon(1e-12));  // round-off of the splines' coefficients
    }
  }
}

TEST_CASE("Interpolated influence is symmetric to the last bit and positive semi-definite", "[core][compliance][fe]") {
  const StationGrid grid = small_grid();
  const InfluenceTable table(grid, kernel_tables(grid, 2));
  const Eigen::MatrixXd k = table.evaluate(kScattered);
  CHECK(k == k.transpose());
  CHECK(lowest_over_highest(k) > -1e-14);  // round-off
  // Again in another order: the same values.
  std::vector<FlankStation> reversed(kScattered.rbegin(), kScattered.rend());
  CHECK((table.evaluate(reversed).reverse() - k).cwiseAbs().maxCoeff() < 1e-14 * k.maxCoeff());
}

TEST_CASE("A table that is not positive semi-definite is lifted by the least amount, and reports it", "[core][compliance][fe]") {
  const StationGrid grid = small_grid();
  std::vector<Eigen::MatrixXd> tables = kernel_tables(grid, 2);
  tables[1] *= 1.6;  // more than a tooth's own influence can be shared with its neighbour
  const InfluenceTable table(grid, tables);
  const TableProjection& projection = table.projection();
  REQUIRE(projection.lowest_eigenvalue < -1e-3);
  CHECK(projection.added == -projection.lowest_eigenvalue);

  std::vector<FlankStation> stations;
  for (const int tooth : {0, 1, 2}) {
    for (const FlankStation& p : grid.stations(tooth)) stations.push_back(p);
  }
  const Eigen::MatrixXd k = table.evaluate(stations);
  const Eigen::VectorXd scale = tables[0].diagonal().cwiseSqrt().cwiseInverse().replicate(3, 1);
  const Eigen::MatrixXd scaled = scale.asDiagonal() * k * scale.asDiagonal();
  const Eigen::VectorXd values = symmetric_eigenvalues(scaled);
  CHECK(values[0] == tests::about(0, 1e-13));  // round-off: neither below 0 nor above
  CHECK(lowest_over_highest(table.evaluate(kScattered)) > -1e-14);
  // Nothing but the own values has moved.
  for (Eigen::Index i = 0; i < k.rows(); ++i) {
    CHECK(k(i, i) == Approx((1 + projection.added) * tables[0](i % grid.size(), i % grid.size())).epsilon(1e-12));  // round-off, as below
    for (Eigen::Index j = grid.size(); j < k.cols(); ++j) {
      if (i >= grid.size()) continue;
      const double known = tables[static_cast<std::size_t>(j / grid.size())](i, j % grid.size());
      CHECK(k(i, j) == tests::about(known, 1e-12));  // round-off of the splines' coefficients
    }
  }
  const InfluenceTable again(grid, table.tables(), projection);
  CHECK(again.evaluate(kScattered) == table.evaluate(kScattered));
}

TEST_CASE("A table refuses what it does not know", "[core][compliance][fe]") {
  const StationGrid grid = small_grid();
  const InfluenceTable table(grid, kernel_tables(grid, 1));
  CHECK_NOTHROW(table.evaluate(std::vector<FlankStation>{{0, 0, 1}, {1, 0, 1}}));
  CHECK_THROWS_AS(table.evaluate(std::vector<FlankStation>{{0, 0, 1}, {2, 0, 1}}), InvalidInput);
  CHECK_THROWS_AS(table.evaluate(std::vector<FlankStation>{{0, 0, 3.1}}), InvalidInput);
  CHECK_THROWS_AS(InfluenceTable(grid, {}), InvalidInput);
  CHECK_THROWS_AS(InfluenceTable(grid, {Eigen::MatrixXd::Identity(3, 3)}), InvalidInput);
  CHECK_THROWS_AS(InfluenceTable(grid, {Eigen::MatrixXd::Zero(grid.size(), grid.size())}), InvalidInput);
}
