#include "core/compliance/local/strip_contact.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/units.hpp"
#include "core/compliance/local/contact_law.hpp"
#include "core/compliance/local/hertz_line.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using units::pi;

namespace {

constexpr double modulus = 113'000, flank_radius = 10;

double hertz_width(double load) { return hertz_line(load, flank_radius, modulus).half_width; }

/// A strip contact by boundary elements of constant pressure: the approach at the load, the highest pressure and the ends.
struct BoundaryElements {
  double approach, highest, begin, end;
};

/// Half-planes with u = -(2/(pi E')) int p log|s - t| dt + approach - h, the logarithm's argument in mm. Elements leave contact where they would pull
/// and enter it where they would overlap.
BoundaryElements boundary_elements(const RoundedEdge& edge, double load, double from, double to) {
  constexpr int n = 240;
  const double width = (to - from) / n;
  const auto place = [&](int i) { return from + (i + 0.5) * width; };
  const auto integral = [](double x) { return x == 0.0 ? 0.0 : x * (std::log(std::abs(x)) - 1.0); };
  Eigen::MatrixXd kernel(n, n);
  Eigen::VectorXd gap(n);
  for (int i = 0; i < n; ++i) {
    const double s = place(i), beyond = std::max(0.0, s - edge.distance);
    gap[i] = s * s / (2.0 * flank_radius) + beyond * beyond / (2.0 * edge.radius);
    for (int j = 0; j < n; ++j) {
      const double d = s - place(j);
      kernel(i, j) = -2.0 / (pi * modulus) * (integral(d + 0.5 * width) - integral(d - 0.5 * width));
    }
  }
  std::vector<bool> touches(n, true);
  for (int round = 0; round < 60; ++round) {
    std::vector<int> set;
    for (int i = 0; i < n; ++i) {
      if (touches[i]) set.push_back(i);
    }
    const auto m = static_cast<Eigen::Index>(set.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(m + 1, m + 1);
    Eigen::VectorXd right(m + 1);
    for (Eigen::Index i = 0; i < m; ++i) {
      for (Eigen::Index j = 0; j < m; ++j) system(i, j) = kernel(set[i], set[j]);
      system(i, m) = -1.0;
      system(m, i) = width;
      right[i] = -gap[set[i]];
    }
    right[m] = load;
    const Eigen::VectorXd solution = system.partialPivLu().solve(right);
    Eigen::VectorXd pressure = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < m; ++i) pressure[set[i]] = solution[i];
    const Eigen::VectorXd left = kernel * pressure + gap - Eigen::VectorXd::Constant(n, solution[m]);
    bool changed = false;
    for (int i = 0; i < n; ++i) {
      const bool next = touches[i] ? pressure[i] > 0.0 : left[i] < 0.0;
      changed = changed || next != touches[i];
      touches[i] = next;
    }
    if (!changed) return {solution[m], pressure.maxCoeff(), place(set.front()) - 0.5 * width, place(set.back()) + 0.5 * width};
  }
  throw std::runtime_error("the boundary elements did not settle");
}

double central(double step, double above, double below) { return (above - below) / (2.0 * step); }

ContactLaw law_with(const RoundedEdge& edge) {
  const ContactSide side = ContactSide::of({}, 3.0), ended = ContactSide::of({}, 2.5, 0.4, {0.5, INFINITY}, 0.2);
  return {side, ended, flank_radius, modulus, edge};
}

}  // namespace

TEST_CASE("A strip on a rounded edge is that of boundary elements", "[core][compliance][edge]") {
  const double rho = GENERATE(0.1, 0.3), x = GENERATE(0.7, 0.1, -0.6, -2.0, -7.0);
  const double load = 120.0;
  const RoundedEdge edge{rho, x * hertz_width(load)};
  const StripContact strip(edge, flank_radius, modulus, load);
  CAPTURE(rho, x, strip.half_width());
  // The elements reach past the strip, wherever it is: from the flank's undisturbed contact, or the rounding's, by two half widths.
  const double centre = edge.distance >= 0.0 ? 0.0 : edge.distance * flank_radius / (flank_radius + rho);
  const double reach = 1.6 * hertz_width(load) * (x < -1.0 ? 0.25 : 1.0);
  const BoundaryElements found = boundary_elements(edge, load, centre - reach, centre + reach);
  const double discretisation = 0.01;  // 240 elements over the strip and as much beside it
  CHECK(strip.peaks().highest.pressure == Approx(found.highest).epsilon(discretisation));
  CHECK(2.0 * strip.half_width() == Approx(found.end - found.begin).epsilon(0.03));
  const double flat_punch = 2.0 / (pi * modulus) * std::log(2.0 / strip.half_width());
  const double approach = load * flat_punch + strip.rise() + edge.clearance(flank_radius);
  CHECK(approach == Approx(found.approach).epsilon(1e-3));
}

TEST_CASE("Far from the edge on either side a strip is Hertz's", "[core][compliance][edge]") {
  const double load = 80.0, rho = 0.2, L = hertz_width(load);
  constexpr double round_off = 1e-12;
  const StripContact inside({rho, 1.0001 * L}, flank_radius, modulus, load);
  CHECK(inside.peaks().highest.pressure == Approx(hertz_line(load, flank_radius, modulus).peak_pressure).epsilon(round_off));
  CHECK(inside.half_width() == Approx(L).epsilon(round_off));
  const double both = rho * flank_radius / (rho + flank_radius);
  const HertzLine on_rounding = hertz_line(load, both, modulus);
  const StripContact outside({rho, -1.0001 * std::sqrt(1.0 + flank_radius / rho) * L}, flank_radius, modulus, load);
  CHECK(outside.peaks().highest.pressure == Approx(on_rounding.peak_pressure).epsilon(round_off));
  CHECK(outside.half_width() == Approx(on_rounding.half_width).epsilon(round_off));
  CHECK(outside.peaks().on_edge.pressure == outside.peaks().highest.pressure);
  CHECK(inside.peaks().on_edge.pressure == 0.0);
  CHECK(inside.peaks().edge_load.load == 0.0);
  CHECK(outside.peaks().edge_load.load == load);
}

TEST_CASE("A strip's pressure carries its load, on the rounding its part of it, and has its peak", "[core][compliance][edge]") {
  const double x = GENERATE(0.98, 0.5, -0.5, -4.0);
  const double load = 60.0, L = hertz_width(load);
  const StripContact strip({0.15, x * L}, flank_radius, modulus, load);
  constexpr int n = 200'000;
  const double from = -2.0 * L + std::min(0.0, x * L), width = 4.0 * L + std::abs(x * L);
  double carried = 0.0, on_edge = 0.0, highest = 0.0;
  for (int i = 0; i < n; ++i) {
    const double s = from + width * (i + 0.5) / n, p = strip.pressure(s);
    carried += p * width / n;
    if (s > x * L) on_edge += p * width / n;
    highest = std::max(highest, p);
  }
  const double discretisation = 1e-5;  // midpoint rule with a root at either end
  CHECK(carried == Approx(load).epsilon(discretisation));
  // The rounding begins within a step of the rule.
  CHECK(strip.peaks().edge_load.load == tests::about(on_edge, discretisation * load + highest * width / n));
  CHECK(strip.peaks().highest.pressure == Approx(highest).epsilon(discretisation));
}

TEST_CASE("Slopes of a strip by load and edge are those of differences", "[core][compliance][edge]") {
  const double x = GENERATE(0.97, 0.6, 0.0, -0.8, -3.0), rho = GENERATE(0.0, 0.05, 0.4);
  const double load = 100.0, L = hertz_width(load), e = x * L;
  const auto at = [&](double w, double distance) { return StripContact({rho, distance}, flank_radius, modulus, w); };
  const StripContact strip = at(load, e);
  constexpr double differences = 1e-6;  // central, relative step 1e-5
  const double dw = 1e-5 * load, de = 1e-5 * L;
  CAPTURE(x, rho);
  CHECK(strip.growth() ==
        Approx(central(dw, std::log(at(load + dw, e).half_width()), std::log(at(load - dw, e).half_width())) * load).epsilon(differences));
  CHECK(strip.peaks().highest.slope ==
        Approx(central(dw, at(load + dw, e).peaks().highest.pressure, at(load - dw, e).peaks().highest.pressure)).epsilon(differences));
  CHECK(strip.peaks().highest.by_edge ==
        Approx(central(de, at(load, e + de).peaks().highest.pressure, at(load, e - de).peaks().highest.pressure)).epsilon(differences));
  const auto edge_load = [&](double w, double distance) { return at(w, distance).peaks().edge_load.load; };
  CHECK(strip.peaks().edge_load.slope == Approx(central(dw, edge_load(load + dw, e), edge_load(load - dw, e))).epsilon(differences));
  CHECK(strip.peaks().edge_load.by_edge == Approx(central(de, edge_load(load, e + de), edge_load(load, e - de))).epsilon(differences));
  CHECK(strip.half_width_by_edge() == Approx(central(de, at(load, e + de).half_width(), at(load, e - de).half_width())).epsilon(differences));
  // At e = 0 the clearance has a kink in its second derivative.
  const double kink = x == 0.0 ? 2e-5 : differences;
  CHECK(strip.rise_by_edge() == Approx(central(de, at(load, e + de).rise(), at(load, e - de).rise())).epsilon(kink).margin(1e-9));
}

TEST_CASE("A contact law near an edge rises with the load, by its slope", "[core][compliance][edge]") {
  const double distance = GENERATE(0.2, 0.05, 0.0, -0.05, -0.3);
  const RoundedEdge edge{GENERATE(0.15, 0.0), distance};
  const ContactLaw law = law_with(edge);
  double last = 0.0, last_pressure = 0.0;
  for (double w = 0.01; w < 2'000.0; w *= 1.3) {
    const ContactLaw::Response now = law.evaluate(w);
    CHECK(now.deflection > last);
    CHECK(now.slope > 0.0);
    CHECK(law.peak_pressure(w).highest.pressure > last_pressure);
    last = now.deflection;
    last_pressure = law.peak_pressure(w).highest.pressure;
    const double step = 1e-5 * w, de = 1e-6;
    CAPTURE(distance, w);
    const bool kink = std::abs(distance / law.half_width(w) - 1.0) < 1e-4;
    if (kink) continue;
    constexpr double differences = 3e-6;
    CHECK(now.slope == Approx(central(step, law.deflection(w + step), law.deflection(w - step))).epsilon(differences));
    const double by_edge = central(de, law_with({edge.radius, distance + de}).deflection(w), law_with({edge.radius, distance - de}).deflection(w));
    CHECK(law.edge_slope(w) == Approx(by_edge).epsilon(distance == 0.0 ? 1e-3 : 1e-5).margin(1e-8));
  }
}

TEST_CASE("A law with a far edge is the law without", "[core][compliance][edge]") {
  const double w = GENERATE(1.0, 300.0);
  const ContactSide side = ContactSide::of({}, 3.0);
  const ContactLaw plain(side, side, flank_radius, modulus), edged(side, side, flank_radius, modulus, RoundedEdge{0.2, 5.0});
  CHECK(edged.evaluate(w).deflection == plain.evaluate(w).deflection);
  CHECK(edged.evaluate(w).slope == plain.evaluate(w).slope);
  CHECK(edged.peak_pressure(w).highest.pressure == plain.peak_pressure(w).highest.pressure);
  CHECK(edged.edge_slope(w) == 0.0);
}

TEST_CASE("As a rounding vanishes the load goes to that of the sharp edge, monotonically", "[core][compliance][edge]") {
  // The load that an approach presses on an edge, the approach counted from where the undisturbed flanks would touch.
  const auto load_at = [](double rho, double approach) {
    const RoundedEdge edge{rho, -0.1};
    const ContactLaw law = law_with(edge);
    double low = 0.0, high = 1e4;
    for (int i = 0; i < 200; ++i) {
      const double w = 0.5 * (low + high);
      (law.deflection(w) + edge.clearance(flank_radius) < approach ? low : high) = w;
    }
    return low;
  };
  const double approach = 0.006;
  double last = 0.0, last_step = INFINITY;
  for (const double rho : {0.4, 0.1, 0.025, 0.00625, 0.0015625, 0.000390625}) {
    const double load = load_at(rho, approach);
    if (last > 0.0) {
      CHECK(load < last);  // less and less stands in the way
      CHECK(last - load < last_step);
      last_step = last - load;
    }
    last = load;
  }
  CHECK(last_step < 0.01 * last);
  const double sharp = load_at(0.0, approach);
  CHECK(sharp < last);
  CHECK(last - sharp < last_step);  // each step is less than half of the one before
}

TEST_CASE("A strip at a sharp edge is the limit of small roundings and carries its load", "[core][compliance][edge]") {
  const double x = GENERATE(0.95, 0.4, 0.0, -0.7, -4.0);
  const double load = 60.0, L = hertz_width(load), e = x * L;
  const StripContact sharp({0.0, e}, flank_radius, modulus, load), nearly({1e-6, e}, flank_radius, modulus, load);
  constexpr double limit = 1e-3;  // of phi^2, phi^3 = 3 q pi rho/R
  CAPTURE(x);
  CHECK(sharp.half_width() == Approx(nearly.half_width()).epsilon(limit));
  CHECK(sharp.growth() == Approx(nearly.growth()).epsilon(limit));
  CHECK(sharp.rise() == Approx(nearly.rise()).epsilon(limit));
  CHECK(sharp.half_width_by_edge() == Approx(nearly.half_width_by_edge()).epsilon(limit));
  CHECK(sharp.rise_by_edge() == tests::about(nearly.rise_by_edge(), limit));
  double carried = 0.0;
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) {  // s = e - t^2 takes the root out of the pressure at the edge
    const double width = std::sqrt(2.0 * sharp.half_width()) / n, t = (i + 0.5) * width;
    carried += sharp.pressure(e - t * t) * 2.0 * t * width;
  }
  CHECK(carried == Approx(load).epsilon(1e-5));  // midpoint rule with a root at the other end
  CHECK(sharp.pressure(e + 1e-9) == 0.0);
  CHECK(sharp.peaks().edge_load.load == 0.0);
}
