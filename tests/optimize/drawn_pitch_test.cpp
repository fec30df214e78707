#include "optimize/sampling/drawn_pitch.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "optimize/sampling/distribution.hpp"
#include "tests/common/about.hpp"

namespace flankwright {
namespace {

constexpr PitchTolerance small_gear{18, 7.5e-3, 28e-3}, large_gear{200, 10e-3, 60e-3};

/// Single pitch deviation of tooth k, around the gear.
double single_of(const std::vector<double>& cumulative, std::size_t k) {
  return cumulative[k] - cumulative[(k + cumulative.size() - 1) % cumulative.size()];
}

TEST_CASE("Every drawn gear keeps the tolerances of single and cumulative pitch", "[optimize][sampling]") {
  constexpr double round_off = 1e-15;  // of sums of micrometres
  for (const PitchTolerance& tolerance : {small_gear, large_gear}) {
    for (std::uint64_t draw = 0; draw < 2000; ++draw) {
      const std::vector<double> cumulative = drawn_pitch(tolerance, draw);
      REQUIRE(cumulative.size() == static_cast<std::size_t>(tolerance.teeth));
      const auto [low, high] = std::ranges::minmax(cumulative);
      CHECK(high - low <= tolerance.cumulative + round_off);
      double largest = 0.0;
      for (std::size_t k = 0; k < cumulative.size(); ++k) largest = std::max(largest, std::abs(single_of(cumulative, k)));
      CHECK(largest <= tolerance.single + round_off);
    }
  }
}

TEST_CASE("Drawn pitches alternate from tooth to tooth and have the deviation that is asked for", "[optimize][sampling]") {
  // Statistical: 200 gears of 200 teeth, a standard error of 0.5 %. Of independent n_k the single deviations n_k - n_(k-1) have the
  // correlation -1/2 from tooth to tooth and 0 beyond; run-out of so many teeth adds E sin(pi/z), a hundredth of that, squared.
  constexpr double statistical = 0.02;
  double squares = 0.0, next = 0.0, second = 0.0;
  int count = 0;
  for (std::uint64_t draw = 0; draw < 200; ++draw) {
    const std::vector<double> cumulative = drawn_pitch(large_gear, draw);
    const std::size_t z = cumulative.size();
    double sum = 0.0;
    for (std::size_t k = 0; k < z; ++k, ++count) {
      const double here = single_of(cumulative, k);
      squares += here * here;
      next += here * single_of(cumulative, (k + 1) % z);
      second += here * single_of(cumulative, (k + 2) % z);
      sum += here;
    }
    CHECK(std::abs(sum) < 1e-14);  // round-off: around the gear they sum to zero
  }
  // A normal distribution cut off at c = 3/sqrt(2) deviations has 1 - 2 c phi(c)/(2 Phi(c) - 1) of its variance.
  const double c = 3.0 / std::numbers::sqrt2, density = std::exp(-0.5 * c * c) / std::sqrt(2.0 * std::numbers::pi);
  const double left = 1.0 - 2.0 * c * density / (2.0 * normal_probability(c) - 1.0);
  CHECK(std::sqrt(squares / count) == Approx(large_gear.single / 3.0 * std::sqrt(left)).epsilon(statistical));
  CHECK(next / squares == tests::about(-0.5, statistical));
  CHECK(second / squares == tests::about(0.0, statistical));
}

TEST_CASE("The same draw is the same gear, another one another", "[optimize][sampling]") {
  CHECK(drawn_pitch(small_gear, 7) == drawn_pitch(small_gear, 7));
  CHECK(drawn_pitch(small_gear, 7) != drawn_pitch(small_gear, 8));
}

}  // namespace
}  // namespace flankwright
