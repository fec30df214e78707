#include "optimize/assessment/variant_search.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <numeric>

#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

TEST_CASE("Levels fill a budget and never exceed it", "[optimize][assessment]") {
  CHECK(levels_for(2, 100) == std::vector<int>{10, 10});
  CHECK(levels_for(2, 110) == std::vector<int>{11, 10});
  CHECK(levels_for(3, 1) == std::vector<int>{1, 1, 1});
  CHECK(levels_for(8, 690) == std::vector<int>{3, 3, 2, 2, 2, 2, 2, 2});
  for (int variables = 1; variables <= 9; ++variables) {
    for (const std::int64_t budget : {1, 2, 17, 230, 1500}) {
      const std::vector<int> levels = levels_for(variables, budget);
      const auto tried = std::accumulate(levels.begin(), levels.end(), std::int64_t{1}, std::multiplies<>{});
      CHECK(tried <= budget);
      CHECK(tried / levels.back() * (levels.back() + 1) > budget);  // the last one could not have one more
    }
  }
}

TEST_CASE("Levels are evenly spaced, between the bounds or in the middles", "[optimize][assessment]") {
  CHECK(level_value(LevelPlacement::BoundToBound, 0, 5) == 0.0);
  CHECK(level_value(LevelPlacement::BoundToBound, 4, 5) == 1.0);
  CHECK(level_value(LevelPlacement::BoundToBound, 1, 5) == 0.25);
  CHECK(level_value(LevelPlacement::Middles, 0, 2) == 0.25);
  CHECK(level_value(LevelPlacement::Middles, 1, 2) == 0.75);
  CHECK(level_value(LevelPlacement::BoundToBound, 0, 1) == 0.5);
}

TEST_CASE("The search finds the best of all combinations", "[optimize][assessment]") {
  DesignProblem problem(spur({0.0, 12.0}));
  const VariantSearch search = search_variants(problem, LevelPlacement::BoundToBound, 20);
  REQUIRE(search.levels == std::vector<int>{5, 4});
  CHECK(search.tried == 20);
  CHECK(search.failed == 0);
  double least = INFINITY;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 4; ++j) {
      least = std::min(least, problem.objective(problem.analyse(Eigen::Vector2d(i / 4.0, j / 3.0), false)));
    }
  }
  constexpr double round_off = 1e-12;  // the same values scaled by other roundings
  CHECK(search.best.objective == Approx(least).epsilon(round_off));
  // Loads start from another design's here: the solver's tolerance.
  CHECK(problem.objective(problem.analyse(search.x, false)) == Approx(search.best.objective).epsilon(1e-11));
}

TEST_CASE("One thread and two find the same variant, of equals the first", "[optimize][assessment][determinism]") {
  DesignTask task = spur({8.0, -8.0});  // mirrored: +slope and -slope are equals
  const auto search_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return search_variants(DesignProblem(task), LevelPlacement::Middles, 16);
  };
  const VariantSearch one = search_with(1), two = search_with(2);
  CHECK(one.x == two.x);
  CHECK(one.best.objective == two.best.objective);
  CHECK(one.best.design.name == two.best.design.name);
}

TEST_CASE("Variants that break a constraint are counted and not taken", "[optimize][assessment]") {
  DesignTask task = spur({0.0, 12.0});
  task.constraints = {{term(Output::PeakContactStress), 1.0}};  // nothing meets 1 MPa
  const VariantSearch none = search_variants(DesignProblem(task), LevelPlacement::Middles, 9);
  CHECK(none.tried == 9);
  CHECK(none.feasible == 0);
  CHECK(none.x.size() == 0);
  CHECK_FALSE(none.best.objective == none.best.objective);  // never set
}
