#include "core/compliance/thin_slice/tooth_bending.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/base/units.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using units::deg;
using units::pi;

namespace {

ToothForm form_of(int teeth, double module = 5, double beta = 0, double shift = 0) {
  GearData gear;
  gear.teeth = teeth;
  gear.profile_shift = shift;
  gear.rack.root_radius = 0.38;
  return ToothForm(gear, module, 20 * deg, beta);
}

/// A slice given by its thickness over the height.
SlicePiece slice(double from, double to, const std::function<double(double)>& thickness) {
  return {from, to, [=](double y) { return SlicePoint{y, thickness(y), 1.0}; }};
}
SlicePiece even_slice(double from, double to, double s) {
  return slice(from, to, [=](double) { return s; });
}

}  // namespace

TEST_CASE("The profile rises with its parameter as differences of its height say", "[core][gear][compliance]") {
  const int teeth = GENERATE(10, 23, 150);
  const double beta = GENERATE(0.0, 25.0) * deg;
  const ToothForm form = form_of(teeth, 3, beta);
  constexpr double kStep = 1e-5, kDiscretisation = 1e-8;  // central differences: step^2 times third derivatives, round-off over the step
  for (const double share : {0.01, 0.2, 0.5, 0.8, 0.99}) {
    const double lambda = form.fillet_start() + share * (pi / 2 - form.fillet_start());
    const double fillet = (form.fillet_point(lambda + kStep).y - form.fillet_point(lambda - kStep).y) / (2 * kStep);
    CHECK(form.fillet_rise(lambda) == tests::about(fillet, kDiscretisation * form.tip_radius()));
    CHECK(form.fillet_rise(lambda) < 0);
    CHECK(form.fillet_at_height(form.fillet_point(lambda).y) == tests::about(lambda, 1e-6));  // flat at its lowest point
    const double roll = form.involute_start() + share * 3;
    const double involute = (form.involute_point(roll + kStep).y - form.involute_point(roll - kStep).y) / (2 * kStep);
    CHECK(form.involute_rise(roll) == tests::about(involute, kDiscretisation * form.tip_radius()));
    CHECK(form.involute_at_height(form.involute_point(roll).y) == tests::about(roll, 1e-9));
  }
}

TEST_CASE("A slice of constant thickness is the textbook cantilever in plane strain", "[core][compliance][closed-form]") {
  const double s = 2, l = 7, nu = 0.3, a = GENERATE(0.0, 0.4);
  const ToothCompliance q = slice_compliance({even_slice(1, 1 + l, s)}, 1 + l, a, nu);
  const double cos2 = std::cos(a) * std::cos(a), sin2 = std::sin(a) * std::sin(a);
  constexpr double kRoundOff = 1e-13;
  // End load on a beam of unit width: F l^3 / (3 E' I), 1.2 F l / (G A), F l / (E' A), with E' = E/(1 - nu^2), G = E/(2
  // (1 + nu)).
  CHECK(q.bending == Approx((1 - nu * nu) * cos2 * l * l * l / (3 * s * s * s / 12)).epsilon(kRoundOff));
  CHECK(q.shear == Approx(1.2 * 2 * (1 + nu) * cos2 * l / s).epsilon(kRoundOff));
  CHECK(q.compression == Approx((1 - nu * nu) * sin2 * l / s).epsilon(kRoundOff));
}

TEST_CASE("A tapered slice bends as its closed form says", "[core][compliance][closed-form]") {
  // s = s_0 - k y: with s as variable, int (l - y)^2 / s^3 dy has the primitive below.
  const double s0 = 4, k = 0.35, l = 6, nu = 0.25;
  const auto thickness = [&](double y) { return s0 - k * y; };
  const ToothCompliance q = slice_compliance({slice(0, 2.2, thickness), slice(2.2, l, thickness)}, l, 0, nu);
  const double end = s0 - k * l;
  const auto primitive = [&](double s) { return std::log(s) + 2 * end / s - end * end / (2 * s * s); };
  const double integral = (primitive(s0) - primitive(end)) / (k * k * k);
  constexpr double kDiscretisation = 1e-9;  // Gauss rule
  CHECK(q.bending == Approx((1 - nu * nu) * 12 * integral).epsilon(kDiscretisation));
  CHECK(q.shear == Approx(2.4 * (1 + nu) * std::log(s0 / end) / k).epsilon(kDiscretisation));
}

TEST_CASE("The root's rotation is that of a half-plane under a linear traction", "[core][compliance][closed-form]") {
  // Work of sigma = 12 M x / s^3 on the half-plane's displacement -2/(pi E') int sigma ln|x - xi| dxi, M = 1, s = 2:
  // the rotation conjugate to M. The logarithm's singular line is straddled by the two midpoint grids.
  constexpr int kCells = 1500;
  double work = 0;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const double x = -1 + 2 * (i + 0.25) / kCells, xi = -1 + 2 * (j + 0.75) / kCells;
      work -= 2 / pi * (12 * x / 8) * (12 * xi / 8) * std::log(std::abs(x - xi)) * 4 / (kCells * double(kCells));
    }
  }
  const double coefficient = work * 4;                  // theta E' s^2 / M
  CHECK(coefficient == Approx(18 / pi).epsilon(5e-3));  // discretisation
  // The same coefficient out of the code: the second difference of the foundation over the lever.
  const double nu = 0.3;
  const auto foundation = [&](double lever) { return slice_compliance({even_slice(0, lever, 2.0)}, lever, 0, nu).foundation / (1 - nu * nu); };
  const double second = (foundation(6) - 2 * foundation(4) + foundation(2)) / 2;
  CHECK(second == Approx(18 / pi).epsilon(1e-12));  // round-off
}

TEST_CASE("At a Poisson's ratio of 0.3 the foundation has Weber and Banaschek's printed figures", "[core][compliance][reference]") {
  // (F/b)/E cos^2 a (5.2 (l/s)^2 + l/s + 1.4 (1 + 0.294 tan^2 a))
  const double a = 0.35, l = 3, s = 2.4;
  const double tan2 = std::tan(a) * std::tan(a);
  const double printed = std::cos(a) * std::cos(a) * (5.2 * (l / s) * (l / s) + l / s + 1.4 * (1 + 0.294 * tan2));
  const double ours = slice_compliance({even_slice(0, l, s)}, l, a, 0.3).foundation;
  CHECK(ours == Approx(printed).epsilon(0.01));  // model: rounded to two figures, 1.04 to 1
}

TEST_CASE("Tooth compliance does not depend on the module", "[core][compliance]") {
  const ToothForm small = form_of(23, 1, 20 * deg), large = form_of(23, 12, 20 * deg);
  for (const double share : {0.1, 0.5, 1.0}) {
    const double radius = small.form_radius() + share * (small.tip_radius() - small.form_radius());
    CHECK(tooth_compliance(large, std::min(12 * radius, large.tip_radius()), 0.3).total() ==
          Approx(tooth_compliance(small, radius, 0.3).total()).epsilon(1e-9));  // round-off, through the profile's inversion
  }
}

TEST_CASE("A load that points into the rim takes off the beam smoothly", "[core][compliance]") {
  const auto total = [](double lever) { return slice_compliance({even_slice(5, std::max(5.0, 5 + lever), 2.0)}, 5 + lever, 0.3, 0.3).total(); };
  // Value and slope agree from both sides of a load at the root section.
  const double step = 1e-5;
  constexpr double kDiscretisation = 1e-4;  // one-sided differences of a curved function
  CHECK(total(step) - total(0) == Approx(total(0) - total(-step)).epsilon(kDiscretisation));
  CHECK(total(-0.1) < total(0));
}

TEST_CASE("A tooth grows more compliant towards its tip", "[core][compliance]") {
  const int teeth = GENERATE(12, 18, 40, 150, 500);
  const double beta = GENERATE(0.0, 30.0) * deg;
  CAPTURE(teeth, beta);
  const ToothForm form = form_of(teeth, 3, beta);
  double last = 0;
  for (int i = 0; i <= 20; ++i) {
    // From a tenth of the involute up; at its very foot, next to an undercut's waist, the load's lever is short
    // already.
    const double share = 0.1 + 0.9 * i / 20;
    const double radius = std::min(form.form_radius() + share * (form.tip_radius() - form.form_radius()), form.tip_radius());
    const double q = tooth_compliance(form, radius, 0.3).total();
    REQUIRE(q > last);
    last = q;
  }
}

TEST_CASE("The load on a spur tooth meets its centre line at r_b / cos(alpha')", "[core][compliance][closed-form]") {
  // Compression only: its integral runs to the load's height, so two shear figures of one tooth give the height back.
  const ToothForm form = form_of(30);
  const double radius = form.reference_radius();
  const double angle = std::acos(form.base_radius() / radius) - form.half_angle(radius);
  const double root = form.fillet_point(pi / 2).y, top = form.base_radius() / std::cos(angle);
  // Independent route to the integrals: the profile's own polyline, trapezoidal rule.
  double slenderness = 0, height = 0;
  const std::vector<ProfilePoint> profile = form.profile(20000);
  for (std::size_t i = 1; i < profile.size() && profile[i].y < top; ++i) {
    const double y = 0.5 * (profile[i].y + profile[i - 1].y), s = profile[i].x + profile[i - 1].x;
    const double dy = profile[i].y - profile[i - 1].y;
    slenderness += (top - y) * (top - y) / (s * s * s) * dy;
    height += dy / s;
  }
  const ToothCompliance q = tooth_compliance(form, radius, 0.3);
  const double cos2 = std::cos(angle) * std::cos(angle);
  CHECK(root < top);
  CHECK(q.bending == Approx(0.91 * cos2 * 12 * slenderness).epsilon(1e-3));  // discretisation: last cell of the polyline
  CHECK(q.shear == Approx(2.4 * 1.3 * cos2 * height).epsilon(1e-3));
}

TEST_CASE("A helical tooth is its equivalent spur tooth, nearly", "[core][compliance]") {
  // Model: 20 / cos^3(20 deg) = 24.1 teeth; the scaled transverse form keeps the transverse section's taper (measured:
  // 4 %).
  const ToothForm helical = form_of(20, 5, 20 * deg), spur = form_of(24);
  const double q_helical = tooth_compliance(helical, helical.reference_radius(), 0.3).total();
  const double q_spur = tooth_compliance(spur, spur.reference_radius(), 0.3).total();
  CHECK(q_helical == Approx(q_spur).epsilon(0.05));
}
