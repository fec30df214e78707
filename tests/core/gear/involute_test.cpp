#include "core/gear/involute.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

using namespace flankwright;
using units::deg;

TEST_CASE("The inverse involute undoes the involute", "[core][gear]") {
  constexpr double kRoundOff = 1e-14;  // absolute: tan(a) - a loses eps/a for small angles
  for (double angle = 2.0 * deg; angle < 89.0 * deg; angle += 0.37 * deg) {
    CAPTURE(angle / deg);
    CHECK(std::abs(inverse_involute(involute(angle)) - angle) <= kRoundOff);
  }
  for (double value = 1e-3; value < 1e6; value *= 1.7) {
    CAPTURE(value);
    // round-off of tan next to its pole: eps (1 + value) relative
    CHECK(std::abs(involute(inverse_involute(value)) / value - 1.0) <= 1e-15 * (10.0 + 4.0 * value));
  }
}

TEST_CASE("The inverse involute of a small value follows its series to round-off", "[core][gear]") {
  // From inv(a) = a^3/3 + 2 a^5/15 + 17 a^7/315 + ..., reverted: a = q - 2 q^3/15 + 3 q^5/175 - O(q^7/800), q^3 = 3
  // inv.
  constexpr double kRoundOff = 2e-15;  // relative; the series leaves out less than q^6/700
  for (double value = 1e-300; value < 1e-9; value *= 997.0) {
    const double q = std::cbrt(3.0 * value);
    const double series = q * (1.0 - 2.0 / 15.0 * q * q + 3.0 / 175.0 * std::pow(q, 4));
    CAPTURE(value);
    CHECK(std::abs(inverse_involute(value) / series - 1.0) <= kRoundOff);
  }
  CHECK(inverse_involute(0.0) == 0.0);
}

TEST_CASE("The involute of 20 degrees is the handbooks' 0.014904", "[core][gear][reference]") {
  CHECK(std::abs(involute(20 * deg) - 0.014904) <= 5e-7);  // model: printed to six decimals
}

TEST_CASE("Only a finite value of at least zero has an inverse involute", "[core][gear]") {
  CHECK_THROWS_AS(inverse_involute(-1e-9), InvalidInput);
  CHECK_THROWS_AS(inverse_involute(std::numeric_limits<double>::quiet_NaN()), InvalidInput);
  CHECK_THROWS_AS(inverse_involute(std::numeric_limits<double>::infinity()), InvalidInput);
}
