#include "core/compliance/comparison/finite_element_deflections.hpp"

#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "core/compliance/comparison/gear_fit.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"

using namespace flankwright;

TEST_CASE("Deflections under few loads are the gear's influence values, whatever its size and modulus", "[core][compliance][comparison]") {
  const InfluenceModel model(test::gear_of(20, 25, 3), {1, 0.3}, test::coarse());
  const InfluenceModel larger(test::gear_of(20, 25, 3, 0, 4), {206000, 0.3}, test::coarse());
  const std::vector<FlankStation> stations{{-1, 0, 1}, {0, -1, 0}, {0, 0.2, 1.3}, {0, 1, 3}, {1, 0.5, 2}};
  const std::vector<FlankStation> loads{stations[1], stations[3]};
  const auto removed = RemovedRigidMotion::TranslationTorsionAndTilt;
  const Eigen::MatrixXd few = finite_element_deflections(model, stations, loads, removed);
  const Eigen::MatrixXd all = model.influence(flank_points(model.mesh(), stations), removed).compliance;
  constexpr double kRoundOff = 1e-9;  // of solutions on either side of the factor
  CHECK((few.col(0) - all.col(1)).cwiseAbs().maxCoeff() < kRoundOff * all.maxCoeff());
  CHECK((few.col(1) - all.col(3)).cwiseAbs().maxCoeff() < kRoundOff * all.maxCoeff());
  const Eigen::MatrixXd scaled = finite_element_deflections(larger, stations, loads, removed);
  CHECK((scaled - few).cwiseAbs().maxCoeff() < 1e-7 * few.maxCoeff());  // round-off of mesh and factor
  const FlankStation off{0, 1.2, 0};
  CHECK_THROWS_AS(finite_element_deflections(model, {&off, 1}, loads, removed), InvalidInput);
}

TEST_CASE("Samples of several teeth hold the loaded tooth once and both neighbours' mean", "[core][compliance][comparison]") {
  const InfluenceModel model(test::gear_of(20, 25, 3), {1, 0.3}, test::coarse());
  const GearProportions facts{20, 25 * units::deg, 3, 0};
  const std::vector<double> us{-0.5, 0.8}, zetas{0.2, 1.5, 2.9};
  const auto removed = RemovedRigidMotion::TranslationTorsionAndTilt;
  const std::vector<InfluenceSample> samples = finite_element_samples(model, facts, us, zetas, 1, removed);
  REQUIRE(samples.size() == 2);
  CHECK(samples[0].points.size() == 6);
  CHECK(samples[0].compliance == samples[0].compliance.transpose());
  CHECK(samples[1].points.size() == 12);
  CHECK(samples[1].compliance.topLeftCorner(6, 6) == samples[0].compliance);
  CHECK(samples[1].compliance.bottomRightCorner(6, 6) == samples[0].compliance);
  for (const InfluenceSample& sample : samples) CHECK_NOTHROW(sample.validate());

  std::vector<FlankStation> stations = samples[1].points;
  for (const FlankStation& station : samples[0].points) stations.push_back({-1, station.u, station.zeta});
  const Eigen::MatrixXd K = model.influence(flank_points(model.mesh(), stations), removed).compliance;
  // Load on tooth 0: what tooth 1 does, and what tooth -1 does, seen from there one pitch ahead.
  const Eigen::MatrixXd mean = 0.5 * (K.block(0, 6, 6, 6) + K.block(12, 0, 6, 6));
  CHECK((samples[1].compliance.topRightCorner(6, 6) - mean).cwiseAbs().maxCoeff() < 1e-9 * K.maxCoeff());
}
