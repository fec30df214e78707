#include "core/base/natural_spline.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/common/about.hpp"

using flankwright::NaturalSpline;
using flankwright::tests::about;

TEST_CASE("A natural spline passes through its points and is straight where they are", "[core][base]") {
  constexpr double kRoundOff = 1e-14;
  const std::vector<double> x{-1, 0.5, 0.7, 3, 4}, y{2, -1, 0.25, 7, 7.5};
  const NaturalSpline spline(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK(spline(x[i]) == about(y[i], kRoundOff));
  std::vector<double> straight;
  for (const double t : x) straight.push_back(3 - 2 * t);
  for (const double t : {-2.0, 0.6, 1.0, 5.0}) CHECK(NaturalSpline(x, straight)(t) == about(3 - 2 * t, 10 * kRoundOff));
  CHECK(NaturalSpline({1, 3}, {5, 9})(4) == Approx(11).epsilon(kRoundOff));
  CHECK(NaturalSpline({1}, {5})(4) == 5);
}

TEST_CASE("A natural spline has a continuous curvature that ends at 0", "[core][base]") {
  const NaturalSpline spline({0, 1, 2.5, 3}, {0, 1, -1, 0.5});
  constexpr double h = 1e-3;
  // Exact for cubics as long as no knot lies in between, so one-sided stencils.
  const auto second = [&](double x, double side) {
    const double s = side * h;
    return (2 * spline(x) - 5 * spline(x + s) + 4 * spline(x + 2 * s) - spline(x + 3 * s)) / (h * h);
  };
  constexpr double kRoundOff = 1e-8;  // of values near 1 over h^2
  for (const double knot : {1.0, 2.5}) CHECK(second(knot, 1) == about(second(knot, -1), kRoundOff));
  CHECK(second(0, 1) == about(0, kRoundOff));
  CHECK(second(3, -1) == about(0, kRoundOff));
}
