#include "core/gear/tooth_form.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using units::deg;
using units::pi;

namespace {

GearData gear_of(int teeth, double profile_shift = 0, double root_radius = 0.38, double dedendum = 1.25) {
  GearData gear;
  gear.teeth = teeth;
  gear.profile_shift = profile_shift;
  gear.rack.dedendum = dedendum;
  gear.rack.root_radius = root_radius;
  return gear;
}

/// Half angle of the tooth at a radius by brute force: at every rolling position the rack removes what it covers, so
/// the tooth keeps the smallest half angle that any point of the rack's outline reaches at that radius. Uses no
/// envelope condition.
double swept_half_angle(const GearData& gear, double m, double alpha, double beta, double radius) {
  const double h = gear.rack.dedendum * m, rho = gear.rack.root_radius * m;
  const double shift = gear.profile_shift * m + gear.tooth_thickness_allowance / (2 * std::tan(alpha));  // both flanks of the rack move in
  const double r = gear.teeth * m / (2 * std::cos(beta));
  double smallest = pi;
  // A point of the outline at depth d below the rolling line and distance e from the tooth's centre line.
  const auto visit = [&](double d, double e) {
    const double up = r - d;
    if (radius < up) return;
    const double reach = std::sqrt(radius * radius - up * up);
    for (const double lateral : {reach, -reach}) {
      smallest = std::min(smallest, (e - lateral) / r + std::atan2(lateral, up));
    }
  };
  constexpr int kSamples = 40000;
  const double junction = h - rho * (1 - std::sin(alpha));  // below the tool's reference line
  const double highest = -2.5 * m;
  for (int i = 0; i <= kSamples; ++i) {
    const double depth = highest + (junction - highest) * i / kSamples;
    visit(depth - shift, (pi / 4 * m + depth * std::tan(alpha)) / std::cos(beta));
    const double turn = alpha + (pi / 2 - alpha) * i / kSamples;
    const double centre = pi / 4 * m + (h - rho) * std::tan(alpha) + rho / std::cos(alpha);
    visit(h - rho * (1 - std::sin(turn)) - shift, (centre - rho * std::cos(turn)) / std::cos(beta));
  }
  return smallest;
}

}  // namespace

TEST_CASE("The involute starts where Haddad's finite-element gears start theirs", "[core][gear][reference]") {
  // Haddad 1991, appendix 1A and ch. 2: m_n 10, beta 30, alpha_n 20, x 0, tool addendum 1.25, tip radius 0.39.
  const double module = 10;
  constexpr double kModel = 1e-3;  // model: printed to 1e-3 mm
  const GeneratedProfile small = generated_profile(gear_of(18, 0, 0.39), module, 20 * deg, 30 * deg);
  const GeneratedProfile large = generated_profile(gear_of(40, 0, 0.39), module, 20 * deg, 30 * deg);
  CHECK(small.form_radius == tests::about(96.916, kModel));
  CHECK(large.form_radius == tests::about(222.267, kModel));
  CHECK_FALSE(small.undercut);
  CHECK_FALSE(large.undercut);
}

TEST_CASE("The profile is the boundary of what a rolling rack sweeps", "[core][gear][tooth-form]") {
  struct Case {
    int teeth;
    double shift, beta, rounding, dedendum, allowance{0};
  };
  const Case c = GENERATE(Case{18, 0, 30, 0.39, 1.25}, Case{40, -0.4, 15, 0.25, 1.4}, Case{9, 0, 0, 0.38, 1.25}, Case{6, 0.1, 30, 0.2, 1.2},
                          Case{25, 1.5, 0, 0.3, 1.25}, Case{100, 0, 20, 0, 1.25}, Case{19, 0.3, 25, 0.38, 1.25, -0.2});
  CAPTURE(c.teeth, c.shift, c.beta, c.rounding, c.allowance);
  const double module = 4, alpha = 20 * deg, beta = c.beta * deg;
  GearData gear = gear_of(c.teeth, c.shift, c.rounding, c.dedendum);
  gear.tooth_thickness_allowance = c.allowance;
  const ToothForm form(gear, module, alpha, beta);
  for (int i = 1; i <= 12; ++i) {
    // Off the reference radius itself, where the sweep's samples approach the generating point as a square root.
    const double radius = form.root_radius() + (form.tip_radius() - form.root_radius()) * (i - 0.4) / 12;
    CAPTURE(radius, form.form_radius(), form.undercut());
    // Discretisation: the minimum over samples overshoots by the square of their spacing; a sharp corner is sampled
    // exactly.
    constexpr double kDiscretisation = 1e-7;
    CHECK(form.half_angle(radius) == tests::about(swept_half_angle(gear, module, alpha, beta, radius), kDiscretisation));
  }
}

TEST_CASE("Fillet and involute share point and tangent unless the tooth is undercut", "[core][gear][tooth-form]") {
  const double beta = GENERATE(0.0, 15.0, 35.0) * deg;
  const int teeth = GENERATE(20, 35, 200);
  CAPTURE(beta, teeth);
  const ToothForm form(gear_of(teeth, 0.1), 3, 20 * deg, beta);
  REQUIRE_FALSE(form.undercut());
  const ProfilePoint fillet = form.fillet_point(form.fillet_start());
  const ProfilePoint involute = form.at_radius(form.form_radius());
  const double kRoundOff = 1e-11 * form.tip_radius();  // the roll length of the start is a difference of lengths
  CHECK(fillet.x == tests::about(involute.x, kRoundOff));
  CHECK(fillet.y == tests::about(involute.y, kRoundOff));
  CHECK(fillet.tangent_angle == tests::about(involute.tangent_angle, 1e-10));
}

TEST_CASE("An undercut fillet crosses the involute at the form radius, at an angle", "[core][gear][tooth-form]") {
  const ToothForm form(gear_of(8), 5, 20 * deg, 0);
  REQUIRE(form.undercut());
  CHECK(form.form_radius() > form.base_radius());
  const ProfilePoint fillet = form.fillet_point(form.fillet_start());
  const ProfilePoint involute = form.at_radius(form.form_radius());
  constexpr double kRoundOff = 1e-11;
  CHECK(fillet.x == tests::about(involute.x, kRoundOff));
  CHECK(fillet.y == tests::about(involute.y, kRoundOff));
  CHECK(fillet.tangent_angle < involute.tangent_angle - 0.1);
}

TEST_CASE("The fillet's tangent is its derivative and its normal meets the rolling circle", "[core][gear][tooth-form]") {
  const double beta = GENERATE(0.0, 30.0) * deg;
  const ToothForm form(gear_of(18), 10, 20 * deg, beta);
  for (const double lambda : {0.6, 0.9, 1.2, 1.5}) {
    CAPTURE(beta, lambda);
    const double step = 1e-5;
    const ProfilePoint p = form.fillet_point(lambda), a = form.fillet_point(lambda - step), b = form.fillet_point(lambda + step);
    constexpr double kDiscretisation = 1e-8;  // central difference
    CHECK(p.tangent_angle == tests::about(std::atan2(b.x - a.x, a.y - b.y), kDiscretisation));
    // Law of gearing: the rolling point that belongs to this position lies on the normal.
    const double theta = lambda - p.tangent_angle;
    const double r = form.reference_radius();
    const double along = (r * std::sin(theta) - p.x) * std::sin(p.tangent_angle) - (r * std::cos(theta) - p.y) * std::cos(p.tangent_angle);
    CHECK(along == tests::about(0, 1e-12 * r));  // round-off
  }
}

TEST_CASE("The fillet ends on the root circle, square to the radius", "[core][gear][tooth-form]") {
  const ToothForm form(gear_of(27, -0.2), 2.5, 20 * deg, 25 * deg);
  const ProfilePoint lowest = form.fillet_point(pi / 2);
  constexpr double kRoundOff = 1e-12;
  CHECK(std::hypot(lowest.x, lowest.y) == Approx(form.root_radius()).epsilon(kRoundOff));
  CHECK(form.root_radius() == Approx(form.reference_radius() - (1.25 + 0.2) * 2.5).epsilon(kRoundOff));
  CHECK(lowest.tangent_angle == Approx(pi / 2 - std::atan2(lowest.x, lowest.y)).epsilon(kRoundOff));
}

TEST_CASE("Undercut begins at the classical number of teeth", "[core][gear][tooth-form]") {
  // With the straight flank ending one module below the reference line, z_min = 2 / sin^2(20 deg) = 17.097.
  const double rounding = 0.25 / (1 - std::sin(20 * deg));
  CHECK(generated_profile(gear_of(17, 0, rounding), 1, 20 * deg, 0).undercut);
  CHECK_FALSE(generated_profile(gear_of(18, 0, rounding), 1, 20 * deg, 0).undercut);
  // Round-off: at exactly the limiting profile shift the involute starts on the base circle, on both sides of it.
  const double limit = 1 - 12 * std::pow(std::sin(20 * deg), 2) / 2;
  for (const double nudge : {-1e-9, 0.0, 1e-9}) {
    const GeneratedProfile profile = generated_profile(gear_of(12, limit + nudge, rounding), 1, 20 * deg, 0);
    CHECK(profile.form_radius == Approx(6 * std::cos(20 * deg)).epsilon(1e-12));
  }
}

TEST_CASE("The 30 degree tangent of the normal section is 33.69 degrees in Haddad's transverse section", "[core][gear][reference]") {
  const ToothForm form(gear_of(18, 0, 0.39), 10, 20 * deg, 30 * deg);
  const ProfilePoint p = form.root_tangent_point(30 * deg);
  CHECK(p.tangent_angle / deg == tests::about(33.69, 0.005));  // model: printed to 0.01 deg
  CHECK(std::hypot(p.x, p.y) < form.form_radius());
  CHECK(std::hypot(p.x, p.y) > form.root_radius());
}

TEST_CASE("Points asked for by radius or height lie there", "[core][gear][tooth-form]") {
  const ToothForm form(gear_of(GENERATE(8, 33)), 6, 20 * deg, 18 * deg);
  constexpr double kRoundOff = 1e-12;
  for (const ProfilePoint& p : form.profile(25)) {
    const double radius = std::hypot(p.x, p.y);
    const ProfilePoint by_radius = form.at_radius(radius);
    CHECK(std::hypot(by_radius.x, by_radius.y) == Approx(radius).epsilon(kRoundOff));
    CHECK(form.at_height(p.y).y == Approx(p.y).epsilon(kRoundOff));
    CHECK(form.at_height(p.y).x == Approx(p.x).epsilon(1e-6));  // where the fillet runs flat x hangs on the square root of y
  }
}

TEST_CASE("A drawn profile rises from the root to the tip", "[core][gear][tooth-form]") {
  const ToothForm form(gear_of(18), 10, 20 * deg, 0);
  const std::vector<ProfilePoint> profile = form.profile(40);
  REQUIRE(profile.size() == 40);
  constexpr double kRoundOff = 1e-12;
  CHECK(std::hypot(profile.front().x, profile.front().y) == Approx(form.root_radius()).epsilon(kRoundOff));
  CHECK(std::hypot(profile.back().x, profile.back().y) == Approx(form.tip_radius()).epsilon(kRoundOff));
  CHECK(std::is_sorted(profile.begin(), profile.end(), [](const auto& a, const auto& b) { return a.y < b.y; }));
}

TEST_CASE("A tooth whose tip lies above the meeting of its flanks is pointed", "[core][gear][tooth-form]") {
  GearData gear = gear_of(12, 0.8);
  const ToothForm blunt(gear_of(12, 0.0), 1, 20 * deg, 0);
  CHECK(blunt.tip_half_angle() > 0);
  gear.tip_diameter = 18;
  const ToothForm pointed(gear, 1, 20 * deg, 0);
  CHECK(pointed.tip_half_angle() < 0);
  CHECK(pointed.tip_thickness() < 0);
}

TEST_CASE("A rack that cannot exist or severs the tooth is refused by name", "[core][gear][tooth-form]") {
  const auto field = [](const GearData& gear, double alpha) {
    try {
      generated_profile(gear, 1, alpha, 0);
    } catch (const InvalidInput& problem) {
      return problem.field();
    }
    return std::string("accepted");
  };
  const double full = full_tip_rounding(1.25, 20 * deg);
  // At full rounding the bottom of the space has no straight part: both fillets end in its middle.
  const ToothForm round(gear_of(30, 0, full), 1, 20 * deg, 0);
  const ProfilePoint lowest = round.fillet_point(pi / 2);
  CHECK(std::atan2(lowest.x, lowest.y) == Approx(pi / 30).epsilon(1e-12));  // round-off
  CHECK(field(gear_of(30, 0, full), 20 * deg) == "accepted");
  CHECK(field(gear_of(30, 0, full + 1e-6), 20 * deg) == "rack.root_radius");
  CHECK(field(gear_of(30, 0, -0.1), 20 * deg) == "rack.root_radius");
  CHECK(field(gear_of(30, 0, 0, 2.5), 20 * deg) == "rack.dedendum");
  CHECK(field(gear_of(4), 20 * deg) == "teeth");
  CHECK(field(gear_of(30), 50 * deg) == "pressure_angle");
  CHECK(field(gear_of(5, -0.5, 0), 10 * deg) == "profile_shift");
}
