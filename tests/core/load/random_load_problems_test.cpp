#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/load/load_cases.hpp"

using namespace flankwright;
using load_cases::Random;

namespace {

/// Solves random problems of 1 .. largest points, small ones most often; reports the worst of all, not each.
void check_random_problems(int count, double largest, std::uint64_t seed) {
  constexpr double kRoundOff = 1e-9;
  Random random(seed);
  int failed = 0, most_iterations = 0, first_failure = -1;
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    const LoadProblem problem =
        load_cases::random_problem(static_cast<int>(random.log_uniform(1.0, largest + 1.0)), random);
    const LoadDistribution found = solve_load_distribution(problem);
    const bool good = found.usable() && found.kkt_residual <= kRoundOff &&
                      load_cases::optimality(problem, found.line_load, found.transmission_error).worst() <= kRoundOff;
    if (!good) {
      if (failed++ == 0) first_failure = i;
      continue;
    }
    worst = std::max(worst, found.kkt_residual);
    most_iterations = std::max(most_iterations, found.iterations);
  }
  CAPTURE(count, first_failure, worst, most_iterations);
  CHECK(failed == 0);
  CHECK(most_iterations <= 30);  // Newton: a handful, 9 when written
}

}  // namespace

TEST_CASE("Every one of 3000 random load problems is solved", "[core][load][hard]") {
  check_random_problems(3000, 200, 1991);
}

TEST_CASE("Every one of 100000 random load problems is solved", "[.soak][core][load]") {
  check_random_problems(99700, 200, 2026);
  check_random_problems(300, 2000, 2027);
}
