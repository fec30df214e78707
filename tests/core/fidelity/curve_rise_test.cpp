#include "core/fidelity/curve_rise.hpp"

#include <catch2/catch.hpp>
#include <vector>

using namespace flankwright;

TEST_CASE("A curve promises its kink where both sides are straight, and the top of a parabola", "[core][fidelity]") {
  constexpr double kRoundOff = 1e-12;
  std::vector<CurveSample> roof, hill;
  for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
    roof.push_back({x, x < 2.3 ? 2.0 * x : 4.6 - (x - 2.3)});
    hill.push_back({x, -(x - 2.3) * (x - 2.3)});
  }
  const CurveRise kink = rise_between(roof, 2), top = rise_between(hill, 2);
  CHECK(kink.x == Approx(2.3).margin(kRoundOff));
  CHECK(kink.height == Approx(4.6).margin(kRoundOff));
  CHECK(top.height >= -kRoundOff);
  CHECK(rise_between(roof, 3).height == Approx(roof[3].y).margin(kRoundOff));  // it falls
}
