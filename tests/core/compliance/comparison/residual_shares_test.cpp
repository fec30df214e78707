#include "core/compliance/comparison/residual_shares.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/compliance/fitted/residual_statistics.hpp"
#include "tests/core/compliance/comparison/distance_compliance.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using flankwright::testing::DistanceCompliance;

namespace {

constexpr double missed_round_off = 1e-12;  // of the sum of the misses, and of 1 with them

/// Places of teeth 0 and 1 with values that a model misses by known amounts.
InfluenceSample missed_sample() {
  InfluenceSample sample{{20, 0, 10, 0}, {}, {}};
  for (int tooth : {0, 1}) {
    for (int i = 0; i < 10; ++i) sample.points.push_back({tooth, 0.1 * i, 0.9 * i});
  }
  sample.compliance = DistanceCompliance().evaluate(sample.points);
  double miss = 0;
  for (Eigen::Index p = 0; p < 20; ++p) {
    for (Eigen::Index q = 0; q <= p; ++q) {
      miss += 1e-4;
      sample.compliance(p, q) = sample.compliance(q, p) = sample.compliance(p, q) / (1 + miss);
    }
  }
  return sample;
}

}  // namespace

TEST_CASE("Fractions of residuals are those of the known pairs, separate for each distance of teeth", "[core][compliance][comparison]") {
  InfluenceSample sample = missed_sample();
  sample.compliance(3, 2) = sample.compliance(2, 3) = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ResidualDistribution> shares = residual_distributions(DistanceCompliance(), 1, {&sample, 1});
  const std::vector<ResidualStatistics> statistics = residual_statistics(DistanceCompliance(), {&sample, 1});
  REQUIRE(shares.size() == 2);
  for (std::size_t m : {0U, 1U}) {
    CHECK(shares[m].teeth_apart == static_cast<int>(m));
    CHECK(shares[m].pairs == statistics[m].pairs);
    CHECK(shares[m].median() == statistics[m].median);
    CHECK(shares[m].share_95() == statistics[m].share_95);
    CHECK(shares[m].worst() == statistics[m].worst);
    CHECK(std::is_sorted(shares[m].residual.begin(), shares[m].residual.end()));
  }
  // 210 pairs, the last ones on one tooth: their residuals rise by 1e-4 each.
  CHECK(shares[0].worst() == Approx(0.021).epsilon(missed_round_off));
  CHECK(shares[1].pairs == 100);
  // Between teeth the own compliances are at least four times as large as what both have in common.
  CHECK(shares[0].worst_of_own < 0.022);
  CHECK(shares[1].worst_of_own < 0.3 * shares[1].worst());
}

TEST_CASE("A pair without a model value has an infinite residual, and the other pairs keep theirs", "[core][compliance][comparison]") {
  struct Partial final : FlankCompliance {
    Eigen::MatrixXd evaluate(std::span<const FlankStation> points) const override {
      Eigen::MatrixXd K = DistanceCompliance().evaluate(points);
      K(3, 2) = K(2, 3) = std::numeric_limits<double>::quiet_NaN();
      return K;
    }
  };
  const InfluenceSample sample = missed_sample();
  const ResidualDistribution partial = residual_distributions(Partial(), 1, {&sample, 1})[0];
  const ResidualDistribution whole = residual_distributions(DistanceCompliance(), 1, {&sample, 1})[0];
  CHECK(std::is_sorted(partial.residual.begin(), partial.residual.end()));
  CHECK(std::isinf(partial.worst()));
  CHECK(std::isinf(partial.worst_of_own));
  CHECK(partial.pairs == whole.pairs);
  CHECK(partial.at(0.2) == tests::about(whole.at(0.2), 1.01e-4));  // one pair further, a step of this sample
  CHECK(std::isinf(residual_statistics(Partial(), {&sample, 1})[0].worst));
}

TEST_CASE("A model of one tooth is judged on one tooth", "[core][compliance][comparison]") {
  const InfluenceSample sample = missed_sample();
  const std::vector<ResidualDistribution> shares = residual_distributions(DistanceCompliance(), 0, {&sample, 1});
  REQUIRE(shares.size() == 1);
  CHECK(shares[0].pairs == 55);
  CHECK(shares[0].worst() == Approx(0.0055).epsilon(missed_round_off));
}
