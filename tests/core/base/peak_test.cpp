#include "core/base/peak.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace flankwright;

namespace {

struct Sample {
  double x, f, df;
  double position() const { return x; }
  double value() const { return f; }
  double slope() const { return df; }
};

constexpr PeakTolerance tolerance{1e-9, 1e-15, 1e-6};

}  // namespace

TEST_CASE("A smooth maximum is found where the slope vanishes, in a few samples", "[core][base][closed-form]") {
  int samples = 0;
  const auto f = [&](double x, const Sample*) {
    ++samples;
    return Sample{x, std::sin(x), std::cos(x)};
  };
  const double guess = GENERATE(0.2, 1.4, 2.9);
  const Peak<Sample> peak = find_peak<Sample>(f, 0.0, 3.0, guess, 1.0, tolerance);
  CHECK(std::abs(peak.top.x - std::acos(-1.0) / 2) <= 1e-8);  // the tolerance's step, and the slope it leaves
  CHECK_FALSE(peak.at_end);
  CHECK(samples <= 12);
}

TEST_CASE("A kink is found with both its sides, and the mean of their slopes that vanishes", "[core][base][closed-form]") {
  const double rise = GENERATE(1e-2, 0.3, 5.0), fall = GENERATE(1e-2, 2.0), bend = GENERATE(0.0, 0.01, -1e-7);
  int samples = 0;
  const auto f = [&](double x, const Sample*) {
    ++samples;
    const double d = x - 0.4321;
    return d < 0.0 ? Sample{x, rise * d + bend * d * d * d, rise + 3 * bend * d * d} : Sample{x, -fall * d, -fall};
  };
  const Peak<Sample> peak = find_peak<Sample>(f, -1.0, 2.0, 0.1, 1.0, tolerance);
  CAPTURE(rise, fall, bend, samples);
  CHECK(std::abs(peak.top.f) <= 1e-12);
  const auto share = peak.share_of_falling();
  REQUIRE(share);
  CHECK(std::abs(*share - rise / (rise + fall)) <= 1e-9);
  CHECK(samples <= 60);
}

TEST_CASE("A function that rises to an end has its maximum there", "[core][base]") {
  const double sign = GENERATE(1.0, -1.0);
  const auto f = [&](double x, const Sample*) { return Sample{x, sign * x - 0.1 * x * x, sign - 0.2 * x}; };
  const Peak<Sample> peak = find_peak<Sample>(f, -2.0, 2.0, 0.3, 0.2, tolerance);
  CHECK(peak.at_end);
  CHECK(peak.top.x == sign * 2.0);
}
