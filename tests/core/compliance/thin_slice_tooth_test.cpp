#include "core/compliance/thin_slice/thin_slice_tooth.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/thin_slice/tooth_bending.hpp"
#include "core/compliance/tooth/flank_stations.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;

namespace {

ToothForm helical_form() {
  GearData gear;
  gear.teeth = 18;
  return ToothForm(gear, 2, 20 * units::deg, 30 * units::deg);
}

}  // namespace

TEST_CASE("Thin slices under many point loads yield as under the line load that these make up", "[core][compliance][thin-slice][physics]") {
  const ToothForm form = helical_form();
  const double u = GENERATE(-0.5, 1.0), calibration = 1.3;
  const ThinSliceTooth teeth(form, 2, 16, 0.3, calibration);  // B = 8
  const double cos_beta = std::cos(30 * units::deg);
  constexpr int kLoads = 64;  // ten per spread and more: the hat's kinks lie on loads
  std::vector<FlankStation> points{{0, u, 4}};
  const double step = ThinSliceTooth::kSpread / 16;  // along the trace [m_n]
  for (int i = -kLoads; i <= kLoads; ++i) points.push_back({0, u, 4 + i * step * cos_beta});
  // A load per length of 1 at each point: step; the trapezoidal rule is exact for a hat with its kinks on nodes.
  const double deflection = teeth.evaluate(points).row(0).tail(2 * kLoads + 1).sum() * step;
  const double line = calibration * tooth_compliance(form, flank_radius(form, u), 0.3).total();
  CHECK(deflection == Approx(line).epsilon(1e-12));  // round-off
}

TEST_CASE("Thin slices are not coupled beyond the spread, nor to other teeth", "[core][compliance][thin-slice][physics]") {
  const ThinSliceTooth teeth(helical_form(), 2, 16, 0.3);
  const double reach = ThinSliceTooth::kSpread * std::cos(30 * units::deg);
  const std::vector<FlankStation> points{{0, 0.3, 4}, {0, 0.3, 4 + 0.9 * reach}, {0, 0.3, 4 + 1.1 * reach}, {1, 0.3, 4}};
  const Eigen::MatrixXd K = teeth.evaluate(points);
  CHECK(K == K.transpose());
  CHECK(K(0, 1) == Approx(0.1 * K(0, 0)).epsilon(1e-12));  // round-off of the distance
  CHECK(K(0, 2) == 0);
  CHECK(K(0, 3) == 0);
  CHECK(K(3, 3) == K(0, 0));

  std::vector<FlankStation> many;
  for (const double u : {-1.0, 0.1, 1.0}) {
    for (double zeta = 0; zeta <= 8; zeta += 0.31) many.push_back({0, u, zeta});
  }
  const Eigen::MatrixXd M = teeth.evaluate(many);
  CHECK(symmetric_eigenvalues(M).minCoeff() > -1e-13 * M.trace());
  const FlankStation off{0, 1.2, 3};
  CHECK_THROWS_AS(teeth.evaluate({&off, 1}), InvalidInput);
}
