#include "core/compliance/plate/tapered_plate.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/thin_slice/tooth_bending.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;

namespace {

/// An edge that hardly yields; much less would be round-off beside the plate.
constexpr EdgeCompliance kClamped{1e-5, 0, 1e-5};

PlateShape uniform(double thickness, double height, double length, double nu) {
  PlateShape shape;
  shape.thickness = [thickness](double) { return thickness; };
  shape.heights = {0, height};
  shape.length = length;
  shape.poissons_ratio = nu;
  shape.edge = kClamped;
  return shape;
}

/// Deflection at (x, y) under a unit load per length all along the plate at the height `load`.
double under_line_load(const TaperedPlate& plate, double length, double load, double x, double y) {
  const GaussRule rule(30);
  std::vector<PlateLoad> loads{{x, y, 0.1}};
  for (const double t : rule.nodes) loads.push_back({0.5 * length * (1 + t), load, 0.1});
  return plate.influence(loads).row(0).tail(30).dot(rule.weights) * 0.5 * length;
}

}  // namespace

TEST_CASE("Without Poisson's ratio a plate under a line load is Timoshenko's beam per unit width", "[core][compliance][plate][closed-form]") {
  const double s = 0.9, height = 2.2, load = 1.7;
  PlateShape shape = uniform(s, height, 5, 0);
  shape.edge = {1.3, 0.4, 0.8};
  const TaperedPlate plate(shape, 12, 14);
  const double y = GENERATE(0.6, 1.7, 2.2);
  // Bending and shear below the lower of load and point, the slope above the load, and the foundation.
  const double l = std::min(y, load), I = s * s * s / 12;
  const double beam = load * l * l / (2 * I) - l * l * l / (6 * I) + (y - l) * load * load / (2 * I);
  const double shear = l * 2 / (s * 5 / 6);
  const double edge = 1.3 + 0.4 * (load + y) + 0.8 * load * y;
  CAPTURE(y);
  // Discretisation: the slope's kink at the load is one of the second derivative, polynomials of degree 13 meet it so
  // far.
  CHECK(under_line_load(plate, 5, load, 2.4, y) == Approx(beam + shear + edge).epsilon(4e-3));
}

TEST_CASE("A load on the top edge of a tapered plate strip bends it as a slice in plane strain", "[core][compliance][plate][closed-form][slow]") {
  const auto thickness = [](double y) { return 1.9 - 0.5 * y; };
  PlateShape shape = uniform(1, 2.2, 30, 0.3);
  shape.thickness = thickness;
  const ToothCompliance q = slice_compliance({{0, 2.2, [&](double y) { return SlicePoint{y, thickness(y), 1.0}; }}}, 2.2, 0, 0.3);
  // Far from the ends, which bend anticlastically. Discretisation: 1/s^3 by degree 7, and the ends' decay over 15.
  const double middle = under_line_load(TaperedPlate(shape, 40, 8), 30, 2.2, 15, 2.2);
  CHECK(middle == Approx(q.bending + q.shear).epsilon(1e-4));
  // At free ends nothing holds the anticlastic curvature: they curl back against the load.
  CHECK(under_line_load(TaperedPlate(shape, 40, 8), 30, 2.2, 0, 2.2) < 0.98 * middle);
}

TEST_CASE("A thin plate is Kirchhoff's: the long cantilever plate under a point load at its edge", "[core][compliance][plate][closed-form][slow]") {
  // Independent route: Fourier's integral over the strip's trace. W = a (k y cosh - sinh) + b k y sinh satisfies the
  // plate equation and the clamped foot; no moment and a shear of -1 at the edge y = 1 give a and b.
  const double nu = 0.3;
  const auto edge_deflection = [&](double k) {
    const double c = std::cosh(k), s = std::sinh(k), k2 = k * k, k3 = k2 * k, k4 = k3 * k;
    const double f = k * c - s, f1 = k2 * s, f2 = k2 * s + k3 * c, f3 = 2 * k3 * c + k4 * s;
    const double g = k * s, g1 = k * s + k2 * c, g2 = 2 * k2 * c + k3 * s, g3 = 3 * k3 * s + k4 * c;
    const double mf = f2 - nu * k2 * f, mg = g2 - nu * k2 * g;
    const double vf = f3 - (2 - nu) * k2 * f1, vg = g3 - (2 - nu) * k2 * g1;
    return (mg * f - mf * g) / (mf * vg - mg * vf);
  };
  constexpr double kStep = 0.01, kLast = 100;  // beyond it the integrand is below 0.9/k^3
  double integral = 0;
  for (double k = kStep / 2; k < kLast; k += kStep) integral += edge_deflection(k) * kStep;
  const double infinite_plate = integral / units::pi;
  CHECK(infinite_plate == Approx(0.168).epsilon(0.01));  // Jaramillo 1950, as Timoshenko and Woinowsky-Krieger print it

  const double s = 0.05, D = s * s * s / (12 * (1 - nu * nu));
  PlateShape shape = uniform(s, 1, 8, nu);
  shape.shear_factor = 20;  // hardly any shear deformation
  const std::vector<PlateLoad> load{{4, 1, 0.02}};
  // Discretisation: two thirds of a percent between this basis and a larger one, and free ends four heights away.
  CHECK(TaperedPlate(shape, 48, 10).influence(load)(0, 0) * D == Approx(infinite_plate).epsilon(0.01));
}

TEST_CASE("Influence of a plate is symmetric and positive semi-definite, and grows with the basis towards a limit",
          "[core][compliance][plate][physics]") {
  PlateShape shape = uniform(1, 2.2, 9, 0.3);
  shape.thickness = [](double y) { return 1.9 - 0.5 * y; };
  shape.edge = {1.4, 0.3, 1.5};
  std::vector<PlateLoad> loads;
  for (const double x : {0.0, 0.7, 2.0, 4.4, 6.1, 9.0}) {
    for (const double y : {0.1, 1.0, 2.2}) loads.push_back({x, y, 0.7, 0.7});
  }
  const Eigen::MatrixXd K = TaperedPlate(shape, 30, 6).influence(loads);
  CHECK(K == K.transpose());
  CHECK(symmetric_eigenvalues(K).minCoeff() > -1e-13 * K.trace());

  // Ritz: the energy of every load can only grow with the space.
  Eigen::MatrixXd coarser = TaperedPlate(shape, 8, 3).influence(loads);
  double last_step = std::numeric_limits<double>::infinity();
  for (const auto& [along, up] : {std::pair{14, 4}, {20, 5}, {30, 6}, {45, 8}}) {
    const Eigen::MatrixXd finer = TaperedPlate(shape, along, up).influence(loads);
    const Eigen::MatrixXd gain = finer - coarser;
    CHECK(symmetric_eigenvalues(gain).minCoeff() > -1e-11 * K.trace());
    const double step = gain.cwiseAbs().maxCoeff();
    CHECK(step < last_step);
    last_step = step;
    coarser = finer;
  }
  CHECK(last_step < 3e-3 * K.maxCoeff());  // discretisation
}

TEST_CASE("A plate of which something is impossible is refused", "[core][compliance][plate]") {
  const PlateShape good = uniform(1, 2, 5, 0.3);
  const auto refused = [&](auto change) {
    PlateShape shape = good;
    change(shape);
    CHECK_THROWS_AS(TaperedPlate(shape, 5, 4), InvalidInput);
  };
  refused([](PlateShape& s) { s.length = 0; });
  refused([](PlateShape& s) { s.poissons_ratio = 0.5; });
  refused([](PlateShape& s) { s.shear_factor = 0; });
  refused([](PlateShape& s) { s.edge = {1, 2, 1}; });
  refused([](PlateShape& s) { s.heights = {0}; });
  refused([](PlateShape& s) { s.heights = {0, 0, 1}; });
  CHECK_THROWS_AS(TaperedPlate(good, 1, 4), InvalidInput);
}
