#include "optimize/sampling/distribution.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

TEST_CASE("The normal quantile inverts the distribution function to round-off, far into both tails", "[optimize][distribution]") {
  for (double p = 1e-300; p < 0.5; p *= 7.3) {
    CAPTURE(p);
    const double x = normal_quantile(p);
    // Phi(x) has condition |x| phi/Phi, at most x^2 + 1 in the tail.
    CHECK(normal_probability(x) == Approx(p).epsilon(1e-15 * (x * x + 10.0)));
  }
  for (const double p : {0.001, 0.2, 0.4999}) CHECK(normal_quantile(1.0 - p) == Approx(-normal_quantile(p)).epsilon(1e-12));
  CHECK(std::abs(normal_quantile(0.5)) < 1e-15);
  CHECK(normal_quantile(0.975) == Approx(1.959963984540054).epsilon(1e-14));  // the textbook's 1.96
}

TEST_CASE("Quantiles of the distributions are their closed forms", "[optimize][distribution]") {
  CHECK(Distribution::normal(3.0, 2.0).quantile(0.975) == Approx(3.0 + 2.0 * 1.959963984540054).epsilon(1e-14));
  CHECK(Distribution::uniform(-4.0, 8.0).quantile(0.25) == Approx(-1.0).epsilon(1e-15));
  const Distribution grid = Distribution::grid(0.0, 1.0, 5);
  CHECK(grid.levels() == 5);
  for (int k = 0; k < 5; ++k) CHECK(grid.quantile((k + 0.5) / 5) == 0.25 * k);
  const Distribution words = Distribution::values({7.0, -1.0});
  CHECK(words.quantile(0.499) == 7.0);
  CHECK(words.quantile(0.501) == -1.0);
  CHECK(words.median() == -1.0);
}

TEST_CASE("A truncated normal distribution stays inside, has the truncated moments, and is the normal one where nothing is cut",
          "[optimize][distribution]") {
  const double low = -0.5, high = 2.0;
  const Distribution d = Distribution::truncated_normal(0.0, 1.0, low, high);
  const int n = 100'000;
  double sum = 0.0, previous = -1e300;
  for (int i = 0; i < n; ++i) {
    const double x = d.quantile((i + 0.5) / n);
    REQUIRE((x >= low && x <= high && x >= previous));
    previous = x;
    sum += x;
  }
  const auto density = [](double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); };
  const double share = normal_probability(high) - normal_probability(low);
  // Discretisation: midpoint rule of a bounded monotone function, within (high - low)/n.
  CHECK(sum / n == tests::about((density(low) - density(high)) / share, 2.5 / n));

  const Distribution wide = Distribution::truncated_normal(5.0, 2.0, -1e3, 1e3);
  for (const double u : {1e-6, 0.3, 0.9999}) {
    CHECK(wide.quantile(u) == Approx(Distribution::normal(5.0, 2.0).quantile(u)).epsilon(1e-12));
  }
  CHECK(Distribution::within_tolerance(9.0).quantile(1e-15) >= -9.0);
  CHECK(std::abs(Distribution::within_tolerance(9.0).median()) < 1e-12);
}

TEST_CASE("An invalid distribution is refused by the name of the parameter", "[optimize][distribution]") {
  const auto refused = [](auto make) -> std::string {
    try {
      make();
    } catch (const InvalidInput& problem) {
      return problem.field();
    }
    return "";
  };
  CHECK(refused([] { Distribution::normal(0.0, 0.0); }) == "deviation");
  CHECK(refused([] { Distribution::normal(NAN, 1.0); }) == "mean");
  CHECK(refused([] { Distribution::uniform(1.0, 1.0); }) == "high");
  CHECK(refused([] { Distribution::truncated_normal(0.0, 1.0, 40.0, 41.0); }) == "bounds");
  CHECK(refused([] { Distribution::values({}); }) == "values");
  CHECK(refused([] { Distribution::grid(0.0, 1.0, 1); }) == "levels");
}
