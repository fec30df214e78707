#include "core/base/smooth_interpolation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

const std::vector<double> places{-1.0, -0.7, 0.1, 0.4, 1.5};

template <class F>
double interpolated(const F& f, std::size_t left, double x) {
  const InterpolationWeights weights = smooth_interpolation(places, left, x);
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.count; ++k) sum += weights.weight[k] * f(places[weights.first + k]);
  return sum;
}

}  // namespace

TEST_CASE("Smooth interpolation meets its values, has one slope at each place and is exact on parabolas", "[core][base]") {
  constexpr double kRoundOff = 1e-13, step = 1e-6, kDifference = 1e-5;
  const auto parabola = [](double x) { return 2.0 - 3.0 * x + 0.7 * x * x; };
  const auto wave = [](double x) { return std::sin(2.0 * x); };
  for (std::size_t left = 0; left + 1 < places.size(); ++left) {
    const double a = places[left], b = places[left + 1];
    CHECK(interpolated(wave, left, a) == tests::about(wave(a), kRoundOff));
    CHECK(interpolated(wave, left, b) == tests::about(wave(b), kRoundOff));
    for (const double t : {0.2, 0.5, 0.9}) CHECK(interpolated(parabola, left, a + t * (b - a)) == tests::about(parabola(a + t * (b - a)), kRoundOff));
    if (left + 2 == places.size()) continue;
    const double before = (wave(b) - interpolated(wave, left, b - step)) / step, after = (interpolated(wave, left + 1, b + step) - wave(b)) / step;
    CHECK(before == tests::about(after, kDifference));
  }
}
