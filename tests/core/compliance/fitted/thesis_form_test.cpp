#include "core/compliance/fitted/thesis_form.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "tests/core/compliance/fitted/random_gear.hpp"
#include "core/compliance/fitted/residual_statistics.hpp"
#include "tests/core/compliance/fitted/synthetic_gear.hpp"

using namespace flankwright;
using namespace flankwright::testing;

namespace {

/// C_f1 .. C_f6, C_g2 .. C_g5 of a plausible gear with some dependence on u, then one adjacent tooth.
std::vector<double> plausible() {
  return {1.2,  0.5, 0.1, std::log(0.4), 0.1, 0.0,  0.3, 0.05, 0.0, 0.2, 0.03,          0.01, 0.01,         0, 0, 0.05, 0.01, 0, 0.8, 0.1, 0.05, 0.1,
          0.02, 0,   0.5, 0.05,          0,   -0.2, 0.0, 0.0,  0.2, 0.1, std::log(0.3), 0.05, std::log(0.5)};
}

}  // namespace

TEST_CASE("At one radius the thesis' form is its printed equations", "[core][compliance][fitted][closed-form]") {
  const ThesisBody body = GENERATE(ThesisBody::InMasterFunction, ThesisBody::Separate);
  const double B = 12, z = 3, zF = 4.5;
  const std::vector<FlankStation> stations{{0, 0, z}, {0, 0, zF}, {1, 0.4, 2}};
  const Eigen::MatrixXd K = ThesisCompliance(body, helical_gear(B), plausible()).evaluate(stations);
  const auto G = [&](double at) { return 1 + 0.8 * std::exp(-std::exp(0.1) * at) + 0.5 * std::exp(-std::exp(-0.2) * (B - at)); };
  const auto one_way = [&](double zbar) {
    const double tooth = 1.2 * (std::exp(-0.4 * std::abs(zbar) - 0.05 * zbar) - 0.3 * std::exp(-25 * std::abs(zbar)));
    const double gear = 0.2 + 0.01 * zbar, root = std::sqrt(G(z) * G(zF));
    return body == ThesisBody::Separate ? root * tooth + gear : root * (tooth + gear);
  };
  constexpr double kRoundOff = 1e-14;
  CHECK(K(0, 1) == Approx(0.5 * (one_way(z - zF) + one_way(zF - z))).epsilon(kRoundOff));
  CHECK(K(0, 2) == Approx(0.2 + 0.1 * std::exp(-0.3 * (z + 2)) + 0.05 * std::exp(-0.5 * (2 * B - z - 2))).epsilon(kRoundOff));
  CHECK(K == K.transpose());
}

TEST_CASE("The thesis' form is found again from its own values", "[core][compliance][fitted]") {
  const ThesisBody body = GENERATE(ThesisBody::InMasterFunction, ThesisBody::Separate);
  const ThesisCompliance truth(body, helical_gear(), plausible());
  const SyntheticGear stations(helical_gear());
  const std::vector<FlankStation> grid = stations.grid(4, 9, 0, 1), other = stations.grid(3, 7, 0, 1);
  const InfluenceSample sample{helical_gear(), grid, truth.evaluate(grid)};
  const InfluenceSample unseen{helical_gear(), other, truth.evaluate(other)};
  // Exact derivatives bring it to round-off; wrong ones would stall.
  const ThesisFitResult result = fit_thesis_form({&sample, 1}, body, {300, 1e-12});
  REQUIRE(result.fit);
  CHECK(result.fit->teeth_apart() == 1);
  for (const ResidualStatistics& error : residual_statistics(*result.fit, {&unseen, 1})) {
    CHECK(error.worst < 1e-4);  // discretisation: the solver's stopping test
  }
}

TEST_CASE("The thesis' form refuses what it has no coefficients for", "[core][compliance][fitted]") {
  const ThesisCompliance one_apart(ThesisBody::Separate, helical_gear(), plausible());
  CHECK_THROWS_AS(one_apart.evaluate(std::vector<FlankStation>{{0, 0, 6}, {2, 0, 6}}), InvalidInput);
  CHECK_THROWS_AS(one_apart.evaluate(std::vector<FlankStation>{{0, 0, 12.5}}), InvalidInput);
  CHECK_THROWS_AS(ThesisCompliance(ThesisBody::Separate, helical_gear(), std::vector<double>(31, 0.1)), InvalidInput);
  const SyntheticGear gear(helical_gear());
  const InfluenceSample few = gear.sample(gear.grid(2, 3));
  CHECK_THROWS_AS(fit_thesis_form({&few, 1}, ThesisBody::Separate), InvalidInput);
}
