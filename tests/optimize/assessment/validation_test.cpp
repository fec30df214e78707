#include "optimize/assessment/validation.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

TEST_CASE("A spread has the moments and quantiles of its numbers", "[optimize][assessment]") {
  std::vector<double> values(101);
  std::iota(values.begin(), values.end(), 0.0);  // 0 .. 100: quantiles are the shares themselves
  std::swap(values.front(), values[50]);
  values.push_back(not_given);
  const Spread spread = spread_of(values);
  constexpr double round_off = 1e-12;
  CHECK(spread.count == 101);
  CHECK(spread.failed == 1);
  CHECK(spread.mean == Approx(50.0).epsilon(round_off));
  CHECK(spread.deviation == Approx(std::sqrt(101.0 * 102.0 / 12.0)).epsilon(round_off));  // n (n + 1) / 12 of n integers
  CHECK(spread.least == 0.0);
  CHECK(spread.greatest == 100.0);
  for (std::size_t q = 0; q < Spread::shares.size(); ++q) CHECK(spread.quantiles[q] == Approx(100.0 * Spread::shares[q]).epsilon(round_off));
  CHECK(std::isnan(spread_of({not_given}).mean));
  CHECK(std::isnan(spread_of({1.0}).deviation));
  CHECK(spread_of({1.0}).quantiles[2] == 1.0);
}

TEST_CASE("Shares and histograms count every number once", "[optimize][assessment]") {
  CHECK(share_below({1.0, 2.0, 3.0, not_given}, {2.0, 2.0, 4.0, 0.0}) == 2.0 / 3.0);
  CHECK(std::isnan(share_below({not_given}, {1.0})));
  // The same design analysed twice is not better than itself.
  CHECK(share_below({1.0 - 1e-13, 1.0 + 1e-13, -1.0 - 1e-13}, {1.0, 1.0, -1.0}) == 0.0);
  CHECK(histogram({0.0, 0.5, 0.99, 1.0, 2.0, not_given}, 0.0, 2.0, 2) == std::vector<int>{3, 2});
  CHECK(histogram({1.0, 1.0}, 1.0, 1.0, 3) == std::vector<int>{2, 0, 0});
}

TEST_CASE("Validation gives each design the measures of its own analyses, on one thread and on two", "[optimize][assessment][determinism]") {
  const DesignTask task = spur({0.0});
  const std::vector<DesignScene> drawn = spur({3.0, -7.0, 15.0}).scenes;
  NamedDesign crowned{"crowned", "", {}};
  crowned.modification.pinion.lead_crowning = 0.008;
  const auto validated_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return validate_designs(task, drawn, {{"plain", "", {}}, crowned});
  };
  const std::vector<ValidatedDesign> one = validated_with(1), two = validated_with(2);
  REQUIRE(one.size() == 2);
  DesignProblem problem(spur({3.0, -7.0, 15.0}));
  const DesignAnalysis expected = problem.analyse_design(crowned.modification);
  for (int s = 0; s < 3; ++s) CHECK(one[1].measures[static_cast<std::size_t>(s)] == problem.scene_measure(expected, s));
  for (std::size_t d = 0; d < 2; ++d) CHECK(one[d].measures == two[d].measures);
  // Crowning helps where the mesh is far out of line.
  CHECK(one[1].measures[2] < one[0].measures[2]);
}
