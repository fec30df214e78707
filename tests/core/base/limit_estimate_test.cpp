#include "core/base/limit_estimate.hpp"

#include <catch2/catch.hpp>

using namespace flankwright;

TEST_CASE("A sequence with one power of the step has its order and its distance from the limit", "[core][base][limit-estimate]") {
  const double order = GENERATE(0.8, 1.0, 1.5, 2.0);
  const double limit = GENERATE(-3.0, 7.0), amplitude = GENERATE(-0.4, 0.4);
  const auto value = [&](double step) { return limit + amplitude * std::pow(step, order); };
  const LimitEstimate estimate = estimate_limit(value(1.0), value(0.5), value(0.25));
  CAPTURE(order, limit, amplitude);
  constexpr double kRoundOff = 1e-12;
  CHECK(estimate.regular);
  CHECK(estimate.order == Approx(order).epsilon(kRoundOff));
  CHECK(estimate.error == Approx(std::abs(value(0.25) - limit)).epsilon(kRoundOff));
}

TEST_CASE("A value that its neighbour meets by chance is not taken for an order", "[core][base][limit-estimate]") {
  const LimitEstimate estimate = estimate_limit(1.0, 2.0, 2.0);
  CHECK_FALSE(estimate.regular);
  CHECK(estimate.error == Approx(0.25 / 3.0).epsilon(1e-14));  // second order at best: d1/4, of which a third is left; round-off
}

TEST_CASE("Changes of both signs, or that grow, are not regular and count in full", "[core][base][limit-estimate]") {
  const LimitEstimate alternating = estimate_limit(0.0, 1.0, 0.5), growing = estimate_limit(0.0, 1.0, 3.0);
  CHECK_FALSE(alternating.regular);
  CHECK_FALSE(growing.regular);
  CHECK(alternating.error >= 0.5);
  CHECK(growing.error >= 2.0);
}

TEST_CASE("A sequence that stands still has no error", "[core][base][limit-estimate]") { CHECK(estimate_limit(2.0, 2.0, 2.0).error == 0.0); }
