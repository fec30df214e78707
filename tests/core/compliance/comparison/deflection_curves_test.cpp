#include "core/compliance/comparison/deflection_curves.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/compliance/comparison/distance_compliance.hpp"

using namespace flankwright;
using flankwright::testing::DistanceCompliance;

TEST_CASE("Deflection curves are the models' own values, over the teeth that each of them couples", "[core][compliance][comparison]") {
  const DistanceCompliance compliance;
  const std::vector<NamedModel> models{named_model("all teeth", 2, compliance), named_model("one tooth", 0, compliance)};
  const std::vector<double> zetas{0, 1.5, 3, 6};
  const std::vector<DeflectionCurve> curves = deflection_curves(models, {-1, 0.5}, {0, 6}, zetas, 1);
  // Two heights, two places, three teeth by the first model and one by the second.
  REQUIRE(curves.size() == 2 * 2 * (3 + 1));
  int of_one_tooth = 0;
  for (const DeflectionCurve& curve : curves) {
    CAPTURE(curve.model, curve.load.u, curve.load.zeta, curve.tooth);
    of_one_tooth += curve.model == "one tooth" ? 1 : 0;
    CHECK(curve.load.tooth == 0);
    REQUIRE(curve.value.size() == zetas.size());
    for (std::size_t i = 0; i < zetas.size(); ++i) {
      CHECK(curve.value[i] == DistanceCompliance::between({curve.tooth, curve.load.u, zetas[i]}, curve.load));
    }
  }
  CHECK(of_one_tooth == 4);
  CHECK(curves.front().load == FlankStation{0, -1, 0});
  CHECK(curves.front().tooth == -1);
  CHECK(curves.back().load == FlankStation{0, 0.5, 6});
}

TEST_CASE("A gear's curves have loads at tip, middle and root of both ends and mid face, each among the places looked at",
          "[core][compliance][comparison]") {
  const DistanceCompliance compliance;
  const std::vector<NamedModel> models{named_model("one tooth", 0, compliance)};
  const double face = GENERATE(2.0, 7.3, 12.0, 30.0);
  const std::vector<DeflectionCurve> curves = gear_deflection_curves(models, face, 2);
  REQUIRE(curves.size() == 9);
  for (const DeflectionCurve& curve : curves) {
    CAPTURE(face, curve.load.u, curve.load.zeta);
    double nearest = face, widest = 0;
    for (std::size_t i = 0; i < curve.zeta.size(); ++i) {
      nearest = std::min(nearest, std::abs(curve.zeta[i] - curve.load.zeta));
      if (i > 0) widest = std::max(widest, curve.zeta[i] - curve.zeta[i - 1]);
    }
    CHECK(nearest < 1e-12 * face);  // round-off
    CHECK(widest < 0.25 + 1e-12);
    CHECK(curve.zeta.front() == 0);
    CHECK(curve.zeta.back() == face);
  }
}
