#include "core/compliance/tooth/station_grid.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

template <typename Function>
Eigen::VectorXd table_of(const StationGrid& grid, Function&& f) {
  Eigen::VectorXd table(grid.size());
  Eigen::Index k = 0;
  for (const FlankStation& p : grid.stations()) table[k++] = f(p.u, p.zeta);
  return table;
}

}  // namespace

TEST_CASE("A grid's table is itself at its stations", "[core][compliance]") {
  const StationGrid grid = station_grid(GENERATE(2.0, 7.3, 30.0));
  const std::vector<FlankStation> stations = grid.stations(3);
  REQUIRE(static_cast<Eigen::Index>(stations.size()) == grid.size());
  for (std::size_t k = 0; k < stations.size(); ++k) {
    CHECK(stations[k].tooth == 3);
    CHECK(grid.weights(stations[k]) == Eigen::VectorXd::Unit(grid.size(), static_cast<Eigen::Index>(k)));
  }
}

TEST_CASE("A grid reproduces what is cubic in u and in zeta", "[core][compliance]") {
  const double width = GENERATE(2.0, 12.0);
  const StationGrid grid = station_grid(width);
  const auto f = [&](double u, double zeta) {
    const double t = zeta / width;
    return (1 - 2 * u + 0.5 * u * u + u * u * u) * (2 + t - 3 * t * t + t * t * t);
  };
  const Eigen::VectorXd table = table_of(grid, f);
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const FlankStation p{0, -1 + 0.1 * i, std::min(width, width * j / 20)};
      CHECK(grid.weights(p).dot(table) == tests::about(f(p.u, p.zeta), 1e-12));  // round-off
    }
  }
}

TEST_CASE("Between stations the error falls with the fourth power of the step", "[core][compliance]") {
  const auto f = [](double u, double zeta) { return std::exp(0.7 * u) * std::cos(1.3 * zeta); };
  const auto worst = [&](int radii, int axial) {
    std::vector<double> us, zetas;
    for (int i = 0; i < radii; ++i) us.push_back((2.0 * i - (radii - 1)) / (radii - 1));
    for (int i = 0; i < axial; ++i) zetas.push_back(4.0 * i / (axial - 1));
    const StationGrid grid(us, zetas);
    const Eigen::VectorXd table = table_of(grid, f);
    double error = 0;
    for (int i = 0; i < 37; ++i) {
      for (int j = 0; j < 53; ++j) {
        const FlankStation p{0, -1 + i / 18.0, j / 13.0};
        error = std::max(error, std::abs(grid.weights(p).dot(table) - f(p.u, p.zeta)));
      }
    }
    return error;
  };
  const double coarse = worst(7, 11), fine = worst(13, 21);
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) == tests::about(4, 0.7));  // discretisation: ends converge last
}

TEST_CASE("The steps of a gear's grid grow from both ends alike", "[core][compliance]") {
  const double width = GENERATE(2.0, 3.7, 6.0, 12.0, 30.0);
  const std::vector<double> zetas = station_grid(width).zetas();
  CAPTURE(width, zetas.size());
  CHECK(zetas.front() == 0);
  CHECK(zetas.back() == width);
  CHECK(static_cast<double>(zetas.size()) <= 9 + 1.67 * width);
  const std::size_t n = zetas.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double step = zetas[i + 1] - zetas[i], distance = std::min(zetas[i], width - zetas[i + 1]);
    // No longer than asked for at its far end; the last step of the mesh width may be shared with the other end's.
    CHECK(step <= std::min(0.1 + 0.3 * (distance + step), 0.6) + 1e-12);
    CHECK(zetas[i] + zetas[n - 1 - i] == Approx(width).epsilon(1e-14));  // round-off
  }
}

TEST_CASE("Places off the flank, and axes that do not span it, are refused", "[core][compliance]") {
  const StationGrid grid = station_grid(5);
  CHECK_THROWS_AS(grid.weights({0, 1.01, 2}), InvalidInput);
  CHECK_THROWS_AS(grid.weights({0, -1.01, 2}), InvalidInput);
  CHECK_THROWS_AS(grid.weights({0, 0, -0.01}), InvalidInput);
  CHECK_THROWS_AS(grid.weights({0, 0, 5.01}), InvalidInput);
  CHECK_THROWS_AS(grid.weights({0, std::nan(""), 1}), InvalidInput);
  CHECK_NOTHROW(grid.weights({0, 1 + 1e-12, 5 + 1e-12}));
  const std::vector<double> us{-1, -0.3, 0.3, 1}, zetas{0, 1, 2, 3};
  CHECK_NOTHROW(StationGrid(us, zetas));
  CHECK_THROWS_AS(StationGrid({-1, 0, 1}, zetas), InvalidInput);
  CHECK_THROWS_AS(StationGrid({-1, 0, 0, 1}, zetas), InvalidInput);
  CHECK_THROWS_AS(StationGrid({-1, 0, 0.5, 0.9}, zetas), InvalidInput);
  CHECK_THROWS_AS(StationGrid(us, {0.1, 1, 2, 3}), InvalidInput);
  CHECK_THROWS_AS(station_grid(0), InvalidInput);
  CHECK_THROWS_AS(station_grid(5, 3), InvalidInput);
}
