#include "core/fidelity/cycle_resolution.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/units.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

std::vector<double> cosine(int positions, int order, double amplitude) {
  std::vector<double> samples;
  for (int i = 0; i < positions; ++i) samples.push_back(amplitude * std::cos(2 * units::pi * order * i / positions));
  return samples;
}

}  // namespace

TEST_CASE("Harmonics that half the positions resolve do not change, aliased ones do", "[core][load][resolution]") {
  constexpr double kRoundOff = 1e-14;
  CHECK(cycle_convergence(cosine(32, 3, 2.0)).harmonic_change == tests::about(0, kRoundOff));
  // 16 positions take order 13 for order 3.
  CHECK(cycle_convergence(cosine(32, 13, 2.0)).harmonic_change == Approx(2.0).epsilon(kRoundOff));
  CHECK(cycle_convergence(cosine(32, 16, 1.0)).peak_to_peak_change == Approx(2.0).epsilon(kRoundOff));
  CHECK(cycle_convergence(cosine(32, 3, 2.0)).positions == 32);
  CHECK(std::isnan(cycle_convergence(cosine(31, 3, 2.0)).harmonic_change));
  CHECK(std::isnan(cycle_convergence({1, 2}).harmonic_change));
}
