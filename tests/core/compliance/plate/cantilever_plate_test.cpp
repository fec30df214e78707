#include "core/compliance/plate/cantilever_plate.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/thin_slice/tooth_bending.hpp"
#include "core/compliance/tooth/flank_stations.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;
using units::deg;

namespace {

ToothForm form_of(int teeth, double beta_deg, double module = 1, double shift = 0) {
  GearData gear;
  gear.teeth = teeth;
  gear.profile_shift = shift;
  return ToothForm(gear, module, 20 * deg, beta_deg * deg);
}

}  // namespace

TEST_CASE("Under a line load along the trace the plate yields as thin slices do without compression", "[core][compliance][plate][physics][slow]") {
  const int teeth = GENERATE(18, 60);
  const double beta = GENERATE(0.0, 30.0), face = 20, length = face / std::cos(beta * deg);
  const ToothForm form = form_of(teeth, beta);
  const CantileverPlate plate(form, 1, face, 0.3);
  const double u = GENERATE(-0.3, 0.4, 1.0);
  const ProfilePoint flank = form.at_radius(flank_radius(form, u));
  const double tan_load = std::tan(flank.tangent_angle) * std::cos(beta * deg);
  const double height = flank.y - flank.x * std::cos(beta * deg) * tan_load;
  const double sin2 = tan_load * tan_load / (1 + tan_load * tan_load);
  const ToothCompliance slice = tooth_compliance(form, flank_radius(form, u), 0.3);
  // Of the foundation, 2 (1 - nu^2) (1 - nu)/pi sin^2 a is compression of the root.
  const double across = slice.bending + slice.shear + slice.foundation - 0.91 * 2 * 0.7 / units::pi * sin2;

  const GaussRule rule(40);
  std::vector<PlateLoad> loads{{length / 2, height, 0.5}};
  for (const double t : rule.nodes) loads.push_back({0.5 * length * (1 + t), height, 0.5});
  const double middle = plate.plate().influence(loads).row(0).tail(40).dot(rule.weights) * 0.5 * length;
  CAPTURE(teeth, beta, u);
  // Discretisation: the slope has a kink at a line load, which polynomials round off; the same little shear at any
  // height.
  CHECK(middle * (1 - sin2) < across);
  CHECK(middle * (1 - sin2) > across - 0.15);
}

TEST_CASE("A plate's influence is reciprocal, semi-definite, alike from both ends, and none between teeth", "[core][compliance][plate][physics]") {
  const double face = 8;
  const CantileverPlate plate(form_of(25, 20, 3, 0.2), 3, 3 * face, 0.3);
  std::vector<FlankStation> points;
  for (const double u : {-1.0, 0.0, 1.0}) {
    for (const double zeta : {0.0, 0.4, 2.0, 4.0, 6.0, 7.6, 8.0}) points.push_back({0, u, zeta});
  }
  const auto n = static_cast<Eigen::Index>(points.size());
  const Eigen::MatrixXd K = plate.evaluate(points);
  CHECK(K == K.transpose());
  CHECK(symmetric_eigenvalues(K).minCoeff() > -1e-13 * K.trace());

  std::vector<FlankStation> mirrored = points, apart = points;
  for (FlankStation& point : mirrored) point.zeta = face - point.zeta;
  CHECK((plate.evaluate(mirrored) - K).cwiseAbs().maxCoeff() < 1e-11 * K.maxCoeff());  // round-off

  apart.front().tooth = 1;
  const Eigen::MatrixXd two_teeth = plate.evaluate(apart);
  CHECK(two_teeth.row(0).tail(n - 1).isZero(0));
  CHECK(two_teeth.bottomRightCorner(n - 1, n - 1) == K.bottomRightCorner(n - 1, n - 1));
}

TEST_CASE("The tip yields more than the root, an end more than the middle, and size does not matter", "[core][compliance][plate][physics]") {
  const CantileverPlate plate(form_of(18, 30, 10), 10, 120, 0.3);
  const std::vector<FlankStation> points{{0, 1, 0}, {0, 1, 6}, {0, -0.5, 0}, {0, -0.5, 6}};
  const Eigen::MatrixXd K = plate.evaluate(points);
  CHECK(K(0, 0) > 1.5 * K(1, 1));
  CHECK(K(1, 1) > 2 * K(3, 3));
  CHECK(K(2, 2) > 1.2 * K(3, 3));
  // Discretisation: round-off of the geometry, in modules, through the factorisation.
  CHECK((CantileverPlate(form_of(18, 30, 1), 1, 12, 0.3).evaluate(points) - K).cwiseAbs().maxCoeff() < 1e-9 * K(0, 0));
}

TEST_CASE("Half as many polynomials again change the plate by little", "[core][compliance][plate][slow]") {
  const int teeth = GENERATE(18, 100);
  const double face = GENERATE(2.0, 12.0);
  const ToothForm form = form_of(teeth, 20);
  const CantileverPlate plate(form, 1, face, 0.3), finer(form, 1, face, 0.3, 1.5);
  std::vector<FlankStation> points;
  for (const double u : {-1.0, 0.0, 1.0}) {
    for (const double share : {0.0, 0.05, 0.2, 0.5, 0.8}) points.push_back({0, u, share * face});
  }
  const Eigen::MatrixXd K = plate.evaluate(points), difference = finer.evaluate(points) - K;
  CAPTURE(teeth, face, plate.plate().unknowns(), finer.plate().unknowns());
  double worst = 0;
  for (Eigen::Index p = 0; p < K.rows(); ++p) {
    for (Eigen::Index q = 0; q < K.cols(); ++q) {
      worst = std::max(worst, std::abs(difference(p, q)) / std::sqrt(K(p, p) * K(q, q)));
    }
  }
  CHECK(worst < 0.005);
}

TEST_CASE("A plate knows its flank only", "[core][compliance][plate]") {
  const CantileverPlate plate(form_of(18, 30), 1, 6, 0.3);
  for (const FlankStation& station : {FlankStation{0, 1.1, 3}, {0, -1.1, 3}, {0, 0, -0.1}, {0, 0, 6.1}, {0, 0, NAN}}) {
    CHECK_THROWS_AS(plate.evaluate({&station, 1}), InvalidInput);
  }
}
