#include "optimize/assessment/predicted_statistic.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/assessment/validation.hpp"
#include "optimize/sampling/distribution.hpp"
#include "optimize/sampling/sample_design.hpp"
#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;

namespace {

/// A spur pair of which the mesh misalignment scatters normally with 8 um.
DesignTask drawn(const Aggregation& statistic, int draws, unsigned long seed) {
  DesignTask task = design_tasks::spur({0.0});
  task.resolution.quadrature = {QuadratureRule::Graded, 8};
  const DesignScene nominal = task.scenes.front();
  task.scenes.clear();
  const SampleDesign points(Sampler::MonteCarlo, draws, 1, seed);
  const Distribution misalignment = Distribution::normal(0.0, 8.0);
  for (int i = 0; i < draws; ++i) {
    task.scenes.push_back(nominal);
    task.scenes.back().condition.misalignment.mesh_misalignment = misalignment.quantile(points.point(i)[0]) * units::um;
  }
  task.over = statistic;
  return task;
}

const PerGear<Modification> given;

}  // namespace

TEST_CASE("The interval of a quantile is that of the tables of order statistics", "[optimize][assessment][scatter]") {
  // The median of 100 lies between the 40th and the 61st with 96.5 %; the 41st and 60th hold it with 94.3 % only.
  const auto [low, high] = quantile_interval(0.5, 100, 0.95);
  CHECK(low == 0.40);
  CHECK(high == 0.61);
  // 0.95^30 = 0.21: the largest of 30 draws is below the quantile too often to bound it.
  CHECK(std::isnan(quantile_interval(0.95, 30, 0.95).second));
}

TEST_CASE("The interval holds the quantile of any distribution as often as it says", "[optimize][assessment][scatter]") {
  tests::Random32 random(5);
  constexpr int draws = 200, trials = 4000;
  constexpr double level = 0.9;
  const auto [low, high] = quantile_interval(level, draws, 0.95);
  const std::vector<double> weights(draws, 1.0);
  int held = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> sample(draws);
    std::ranges::generate(sample, [&] { return random(0.0, 1.0); });
    held +=
        aggregate({Aggregate::Quantile, 2.0, low}, sample, weights) <= level && level < aggregate({Aggregate::Quantile, 2.0, high}, sample, weights);
  }
  const double scatter = 3.0 * std::sqrt(0.95 * 0.05 / trials);
  CHECK(static_cast<double>(held) / trials > 0.95 - scatter);
  CHECK(static_cast<double>(held) / trials < 0.99);
}

TEST_CASE("A screened prediction is the statistic of all draws by the task's own resolution", "[optimize][assessment][scatter]") {
  for (const Aggregation& statistic : {Aggregation{Aggregate::Quantile, 2.0, 0.9}, Aggregation{Aggregate::Cvar, 2.0, 0.8}}) {
    CAPTURE(to_string(statistic));
    const DesignTask task = drawn(statistic, 150, 1);
    const PredictedStatistic predicted = predict_statistic(task, given);
    const std::vector<double> all = validate_designs(task, task.scenes, {{"all", "", given}}).front().measures;
    CHECK(predicted.value == aggregate(statistic, all, std::vector<double>(150, 1.0)));
    CHECK(predicted.failed == 0);
    CHECK(predicted.screening_cycles == 150);
    CHECK(predicted.cycles < 2 * 150);
  }
}

TEST_CASE("The statistic over many fresh draws lies in the predicted interval", "[optimize][assessment][scatter]") {
  constexpr int many = 600;
  const DesignTask fresh = drawn(Aggregate::Mean, many, 2);
  const std::vector<double> measures = validate_designs(fresh, fresh.scenes, {{"fresh", "", given}}).front().measures;
  for (const Aggregation& statistic : {Aggregation{Aggregate::Quantile, 2.0, 0.9}, Aggregation{Aggregate::Cvar, 2.0, 0.8},
                                       Aggregation{Aggregate::MeanPlusSigmas, 2.0}, Aggregation{Aggregate::Mean}}) {
    CAPTURE(to_string(statistic));
    const PredictedStatistic predicted = predict_statistic(drawn(statistic, 100, 3), given);
    const double value = aggregate(statistic, measures, std::vector<double>(many, 1.0));
    CHECK(predicted.low < predicted.value);
    CHECK(predicted.value < predicted.high);
    CHECK(predicted.low <= value);
    CHECK(value <= predicted.high);
  }
}
