#include "core/rating/rainflow.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "core/base/units.hpp"
#include "tests/common/random.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

std::map<double, double> counts_by_range(const std::vector<RainflowCycle>& cycles) {
  std::map<double, double> counts;
  for (const RainflowCycle& cycle : cycles) counts[cycle.range] += cycle.count;
  return counts;
}

std::vector<double> random_history(std::size_t length, unsigned seed) {
  tests::Random32 random(seed);
  std::vector<double> history(length);
  for (double& v : history) v = random.integer(-9, 9);
  return history;
}

/// Of all ways from value to value.
double way_of(const std::vector<double>& history) {
  double way = 0.0;
  for (std::size_t i = 0; i + 1 < history.size(); ++i) way += std::abs(history[i + 1] - history[i]);
  return way;
}

double way_of(const std::vector<RainflowCycle>& cycles) {
  double way = 0.0;
  for (const RainflowCycle& cycle : cycles) way += 2.0 * cycle.count * cycle.range;
  return way;
}

}  // namespace

TEST_CASE("Rainflow counts the example of ASTM E1049", "[core][rating][life]") {
  // E1049-85, figure 6: point A -2 to point I -2.
  const std::map<double, double> published{{3.0, 0.5}, {4.0, 1.5}, {6.0, 0.5}, {8.0, 1.0}, {9.0, 0.5}};
  const auto cycles = rainflow({-2, 1, -3, 5, -1, 3, -4, 4, -2});
  CHECK(counts_by_range(cycles) == published);
  // The closed cycle is that between -1 and 3.
  const auto closed = std::ranges::find(cycles, 1.0, &RainflowCycle::count);
  REQUIRE(closed != cycles.end());
  CHECK(closed->range == 4.0);
  CHECK(closed->mean == 1.0);
  // Values on the way between turning points do not count.
  CHECK(counts_by_range(rainflow({-2, -1, 0, 1, 1, -3, 2, 5, -1, 3, 3, -4, 4, 0, -2})) == published);
  CHECK(rainflow({}).empty());
  CHECK(rainflow({7.0}).empty());
  CHECK(rainflow({7.0, 7.0}).empty());
}

TEST_CASE("Rainflow leaves out no part of the way", "[core][rating][life]") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<double> history = random_history(200, seed);
    CHECK(way_of(rainflow(history)) == way_of(history));  // integers
    std::vector<double> closed = history;
    closed.push_back(history.front());
    CHECK(way_of(repeating_rainflow(closed)) == way_of(closed));
    const auto [least, largest] = std::ranges::minmax(history);
    double widest = 0.0;
    for (const RainflowCycle& cycle : rainflow(history)) widest = std::max(widest, cycle.range);
    CHECK(widest == largest - least);
  }
}

TEST_CASE("A history that repeats has whole cycles, wherever it begins", "[core][rating][life]") {
  const std::vector<double> history = random_history(60, 5);
  const auto once = counts_by_range(repeating_rainflow(history));
  for (const auto& [range, count] : once) CHECK(count == std::round(count));
  for (const std::size_t start : {std::size_t{1}, std::size_t{17}, std::size_t{59}}) {
    std::vector<double> later = history;
    std::rotate(later.begin(), later.begin() + static_cast<std::ptrdiff_t>(start), later.end());
    CHECK(counts_by_range(repeating_rainflow(later)) == once);
  }
  // A hundred repetitions counted at a stretch differ from it by what does not close at their ends.
  std::vector<double> often;
  for (int k = 0; k < 100; ++k) often.insert(often.end(), history.begin(), history.end());
  auto counted = counts_by_range(rainflow(often));
  for (const auto& [range, count] : once) CHECK(std::abs(counted[range] - 100.0 * count) <= 2.0);
  // A wave of ten periods has ten cycles of its height.
  std::vector<double> wave;
  for (int i = 0; i < 1000; ++i) wave.push_back(3.0 * std::sin(2.0 * units::pi * i / 100.0));
  double cycles = 0.0;
  for (const RainflowCycle& cycle : repeating_rainflow(wave)) {
    CHECK(cycle.range == Approx(6.0).epsilon(1e-12));  // round-off: samples lie on the crests
    CHECK(cycle.mean == tests::about(0.0, 1e-12));
    cycles += cycle.count;
  }
  CHECK(cycles == 10.0);
}
