#include "core/fidelity/curve_rise.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "tests/common/about.hpp"

using namespace flankwright;

TEST_CASE("A curve promises its kink where both sides are straight, and the top of a parabola", "[core][fidelity]") {
  constexpr double kRoundOff = 1e-12;
  std::vector<CurveSample> roof, hill;
  for (const double x : {-1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}) {
    roof.push_back({x, x < 2.3 ? 2.0 * x : 4.6 - (x - 2.3)});
    hill.push_back({x, -(x - 2.3) * (x - 2.3)});
  }
  const CurveRise kink = rise_between(roof, 3), top = rise_between(hill, 3);
  CHECK(kink.x == tests::about(2.3, kRoundOff));
  CHECK(kink.height == tests::about(4.6, kRoundOff));
  CHECK(top.height >= -kRoundOff);
  CHECK(rise_between(roof, 4).height == tests::about(roof[4].y, kRoundOff));  // it falls
}

TEST_CASE("A sample that is alone on its piece promises a rise to either side, one of a resolved piece does not", "[core][fidelity]") {
  constexpr double kRoundOff = 1e-12;
  // A spike from 3.4 to 4.8 with its top at 4.5 on a falling line: sample 4 alone sees it.
  const auto at = [](double x) { return std::max(10.0 - 0.1 * x, x < 4.5 ? 10.0 + 20.0 * (x - 3.4) : 32.0 - 70.0 * (x - 4.5)); };
  std::vector<CurveSample> curve;
  for (int i = 0; i <= 9; ++i) curve.push_back({static_cast<double>(i), at(i)});
  const double rise = 0.5 * (curve[4].y - curve[3].y);
  for (const std::size_t left : {3U, 4U}) {
    const CurveRise beside = rise_between(curve, left);
    CHECK(beside.x == tests::about(static_cast<double>(left) + 0.5, kRoundOff));
    CHECK(beside.height >= curve[4].y + 0.9 * rise);
  }
  CHECK(rise_between(curve, 4).height == tests::about(curve[4].y + rise, kRoundOff));
  // Where more samples lie on the spike the promise is that of its own sides: the kink.
  curve.clear();
  for (int i = 0; i <= 70; ++i) curve.push_back({2.0 + 0.06 * i, at(2.0 + 0.06 * i)});
  double highest = 0.0;
  for (std::size_t left = 3; left + 4 < curve.size(); ++left) highest = std::max(highest, rise_between(curve, left).height);
  CHECK(highest == Approx(32.0).epsilon(1e-3));
}
