#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/design/outputs/aggregate.hpp"
#include "tests/common/random.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

constexpr Aggregate all_aggregates[] = {Aggregate::Nominal,        Aggregate::Worst, Aggregate::Mean,
                                        Aggregate::MeanPlusSigmas, Aggregate::Cvar,  Aggregate::Quantile};
constexpr double round_off = 1e-14;

std::vector<double> random_numbers(std::size_t n, tests::Random32& random) {
  std::vector<double> numbers(n);
  for (double& x : numbers) x = random(0.5, 5.0);
  return numbers;
}

}  // namespace

TEST_CASE("Aggregates of three scenes are the closed forms", "[optimize][design][closed-form]") {
  const std::vector<double> measures{1.0, 4.0, 2.0}, weights{1.0, 2.0, 1.0};
  // By hand: mean (1 + 8 + 2) / 4, variance (1.75^2 + 2 * 1.25^2 + 0.75^2) / 4.
  const double mean = 2.75, sigma = std::sqrt(1.6875);
  CHECK(aggregate(Aggregate::Nominal, measures, weights) == 1.0);
  CHECK(aggregate(Aggregate::Worst, measures, weights) == 4.0);
  CHECK(aggregate(Aggregate::Mean, measures, weights) == Approx(mean).epsilon(round_off));
  CHECK(aggregate(Aggregate::MeanPlusSigmas, measures, weights) == Approx(mean + 2.0 * sigma).epsilon(round_off));
  CHECK(aggregate({Aggregate::MeanPlusSigmas, 0.5}, measures, weights) == Approx(mean + 0.5 * sigma).epsilon(round_off));
  // The worst 60 % of the weight: 50 % at 4 and 10 % at 2.
  CHECK(aggregate({Aggregate::Cvar, 2.0, 0.4}, measures, weights) == Approx((0.5 * 4.0 + 0.1 * 2.0) / 0.6).epsilon(round_off));
  CHECK(aggregate({Aggregate::Cvar, 2.0, 0.0}, measures, weights) == Approx(mean).epsilon(round_off));
  CHECK(aggregate({Aggregate::Cvar, 2.0, 0.7}, measures, weights) == 4.0);  // within the heaviest scene: the worst case
}

TEST_CASE("Aggregates grow with a common factor and ignore a factor of the weights", "[optimize][design]") {
  tests::Random32 random(3);
  const std::vector<double> measures = random_numbers(6, random), weights = random_numbers(6, random);
  std::vector<double> larger, heavier;
  for (double m : measures) larger.push_back(7.0 * m);
  for (double w : weights) heavier.push_back(3.0 * w);
  for (Aggregate over : all_aggregates) {
    CAPTURE(to_string(over));
    const double value = aggregate(over, measures, weights);
    CHECK(aggregate(over, larger, weights) == Approx(7.0 * value).epsilon(round_off));
    CHECK(aggregate(over, measures, heavier) == Approx(value).epsilon(round_off));
    // Euler: a function homogeneous of degree one is its derivative times its argument.
    const std::vector<double> derivative = aggregate_weights(over, measures, weights);
    double sum = 0.0;
    for (std::size_t s = 0; s < measures.size(); ++s) sum += derivative[s] * measures[s];
    CHECK(sum == Approx(value).epsilon(round_off));
  }
}

TEST_CASE("Derivatives of the aggregates are what central differences say", "[optimize][design]") {
  tests::Random32 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<double> measures = random_numbers(5, random), weights = random_numbers(5, random);
    for (Aggregate over : all_aggregates) {
      const std::vector<double> derivative = aggregate_weights(over, measures, weights);
      for (std::size_t s = 0; s < measures.size(); ++s) {
        constexpr double step = 1e-5, discretisation = 1e-8;  // step^2 times a third derivative of order one
        std::vector<double> up = measures, down = measures;
        up[s] += step;
        down[s] -= step;
        const double difference = (aggregate(over, up, weights) - aggregate(over, down, weights)) / (2.0 * step);
        CAPTURE(to_string(over), trial, s);
        CHECK(derivative[s] == tests::about(difference, discretisation));
      }
    }
  }
}

TEST_CASE("Scenes that are equal but for round-off have no spread", "[optimize][design]") {
  // Sums of thirds and of 0.1 are not exact: a spread of round-off must neither count nor steer.
  const std::vector<double> measures{0.1, 0.1 * (1.0 + 1e-15), 0.1}, weights{1.0, 1.0, 1.0};
  CHECK(aggregate(Aggregate::MeanPlusSigmas, measures, weights) == Approx(0.1).epsilon(round_off));
  for (double w : aggregate_weights(Aggregate::MeanPlusSigmas, measures, weights)) {
    CHECK(w == Approx(1.0 / 3.0).epsilon(round_off));
  }
}

TEST_CASE("The quantile of a sample is its order statistic", "[optimize][design][closed-form]") {
  std::vector<double> measures(100), weights(100, 1.0);
  for (std::size_t s = 0; s < 100; ++s) measures[s] = static_cast<double>((37 * s) % 100 + 1);  // 1 .. 100 in another order
  CHECK(aggregate({Aggregate::Quantile, 2.0, 0.95}, measures, weights) == 95.0);
  CHECK(aggregate({Aggregate::Quantile, 2.0, 0.5}, measures, weights) == 50.0);
  CHECK(aggregate({Aggregate::Quantile, 2.0, 0.0}, measures, weights) == 1.0);
  CHECK(aggregate({Aggregate::Quantile, 2.0, 0.951}, measures, weights) == 96.0);
  // Weights count as copies: 2 of weight 2 is {1, 2, 2, 4}.
  CHECK(aggregate({Aggregate::Quantile, 2.0, 0.75}, {1.0, 2.0, 4.0}, {1.0, 2.0, 1.0}) == 2.0);
  CHECK(aggregate({Aggregate::Quantile, 2.0, 0.76}, {1.0, 2.0, 4.0}, {1.0, 2.0, 1.0}) == 4.0);
  CHECK(to_string(Aggregation{Aggregate::Quantile, 2.0, 0.95}) == "quantile 0.95");
}

TEST_CASE("The mean beyond a quantile is no less than the quantile", "[optimize][design]") {
  tests::Random32 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<double> measures = random_numbers(30, random), weights = random_numbers(30, random);
    for (double level : {0.0, 0.5, 0.9, 0.95}) {
      CAPTURE(trial, level);
      CHECK(aggregate({Aggregate::Cvar, 2.0, level}, measures, weights) >= aggregate({Aggregate::Quantile, 2.0, level}, measures, weights));
    }
  }
}
