#include "core/contact/gap/flank_touch_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/gap/plane_of_action_gap.hpp"
#include "core/contact/gap/surface_gap.hpp"
#include "tests/core/contact/contact_cases.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::deg;
using units::um;

namespace {

constexpr double line_phase = 0.9;

GearPair rounded_pair(double rounding) {
  PairData data = pair_data(23, 57, 20 * deg, 0.2, 0.0, 40.0, 40.0);
  data.pinion.tip_rounding = data.wheel.tip_rounding = rounding;
  return make_gear_pair(data);
}

/// Relief with a kink at its start and one without, crowning below it: what industry grinds, twice over.
FlankCondition relieved() {
  FlankCondition condition;
  condition.modification.pinion.tip_relief = {30 * um, 1.2, ReliefShape::Linear};
  condition.modification.wheel.tip_relief = {25 * um, 1.0, ReliefShape::Parabolic};
  condition.modification.pinion.addendum_crowning = condition.modification.pinion.dedendum_crowning = 15 * um;
  return condition;
}

/// Points along the lines of all teeth, closer than what happens on them.
std::vector<ContactPoint> along_lines(const GearPair& pair, int intervals) {
  const double b = 0.5 * pair.face_width;
  return contact_points(pair, PathOfContact(pair), {QuadratureRule::Midpoint, intervals}, line_phase, true, -b, b);
}

}  // namespace

TEST_CASE("Touches by both flanks' parabola are those of the whole flanks, on flanks and on tip edges", "[core][contact][independent]") {
  const GearPair pair = rounded_pair(0.0);
  const FlankCondition condition = relieved();
  const std::vector<ContactPoint> points = along_lines(pair, 200);
  const Gap plane = plane_of_action_gap(pair, points, condition), surface = SurfaceGap(pair, condition).at(points, line_phase);
  const Gap aligned = SurfaceGap(pair, {}).at(points, line_phase);
  double worst_on_flanks = 0.0, worst_on_edges = 0.0, without = 0.0, largest = 0.0;
  int on_edges = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (points[i].clearance > 20 * um) continue;
    // The whole flanks' clearance is counted as the wheel's lag; what deviations change is compared.
    const double exact = surface.total[k] - aligned.total[k];
    double& worst = points[i].clearance > 0.0 ? worst_on_edges : worst_on_flanks;
    worst = std::max(worst, std::abs(plane.total[k] - points[i].clearance - exact));
    largest = std::max(largest, exact);
    without = std::max(without, std::abs(undisturbed_gap(pair, points[i], condition) - points[i].clearance - exact));
    on_edges += points[i].clearance > 0.0;
  }
  CAPTURE(worst_on_flanks / um, worst_on_edges / um, without / um, largest / um);
  CHECK(on_edges > 10);
  CHECK(without > 1 * um);                   // there is something to find
  CHECK(worst_on_flanks <= 0.04 * without);  // model: third order, the change of R over R h'
  CHECK(worst_on_edges <= 0.03 * largest);   // model: the lever of the wheel's lag, see SurfaceGap
}

TEST_CASE("A parabola of the transmission error leaves what the tool generates as it is", "[core][contact][limit]") {
  PairData data = pair_data(21, 44, 18 * deg);
  const bool of_wheel = GENERATE(false, true);
  (of_wheel ? data.wheel : data.pinion).generation = ParabolicRack{0.0005};
  const GearPair pair = make_gear_pair(data);
  const std::vector<ContactPoint> points = along_lines(pair, 60);
  FlankCondition with_trace;
  with_trace.modification[GENERATE(Member::Pinion, Member::Wheel)].parabolic_te = 1e-12;  // 1/rad: nothing
  const Gap generated = plane_of_action_gap(pair, points, {}), traced = plane_of_action_gap(pair, points, with_trace);
  CHECK(generated.total.maxCoeff() > 1 * um);                             // there is something that could count twice
  CHECK((traced.total - generated.total).cwiseAbs().maxCoeff() <= 1e-9);  // mm: round-off, and the trace
}

TEST_CASE("The gap has no step along a line, neither where a relief starts nor at either end of the path of contact", "[core][contact]") {
  const double rounding = GENERATE(0.0, 0.2);
  const GearPair pair = rounded_pair(rounding);
  const FlankCondition condition = relieved();
  const auto largest_step = [&](int intervals, int& edges) {
    const std::vector<ContactPoint> points = along_lines(pair, intervals);
    const std::vector<FlankTouch> touches = FlankTouchSearch(pair, condition).at(points);
    double largest = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (points[i].tooth != points[i - 1].tooth || points[i].clearance > 5 * um || points[i - 1].clearance > 5 * um) continue;
      edges += (points[i].clearance > 0.0) != (points[i - 1].clearance > 0.0);
      largest = std::max(largest, std::abs(touches[i].gap - touches[i - 1].gap));
    }
    return largest;
  };
  int edges = 0;
  const double coarse = largest_step(2000, edges), fine = largest_step(4000, edges);
  CHECK(edges >= 4);
  CHECK(fine <= 0.52 * coarse);  // discretisation: in proportion to the distance of the points; a step would stay
}

TEST_CASE("Beyond an edge two parabolas touch, or the rounding and a straight flank", "[core][contact]") {
  const GearPair pair = rounded_pair(0.2);
  FlankCondition condition;
  condition.modification.wheel.profile_slope = -20 * um;  // metal rises to the wheel's tip: contact there
  int beyond = 0;
  for (const ContactPoint& point : along_lines(pair, 400)) {
    const FlankTouch touch = FlankTouchSearch(pair, condition).at(point);
    if (touch.on_rounding <= 0.0) continue;
    ++beyond;
    const double rho = pair.wheel.tip_edge_radius, R = point.relative_radius;
    // A brute search over the section: the flank to its edge, then straight on with the rounding's parabola taken off.
    const double edge = touch.along - touch.on_rounding * (R + rho) / rho;
    const double at_edge = touch.sides[0].radius.wheel;
    CHECK(at_edge == Approx(pair.wheel.tip_form_radius).epsilon(1e-12));
    const double step = 1e-4;
    const auto h = [&](double radius) {
      return std::cos(pair.base_helix_angle) * removal(condition.modification.wheel, pair.flank_frame(Member::Wheel), radius, point.z);
    };
    const double slope = (h(at_edge) - h(at_edge - step)) / step * pair.wheel.base_radius / at_edge;
    double least = INFINITY;
    for (double x = edge; x < edge + 0.5; x += 1e-4) {
      least = std::min(least, 0.5 * x * x / R + h(at_edge) + slope * (x - edge) + 0.5 * (x - edge) * (x - edge) / rho);
    }
    CHECK(std::abs(touch.gap - least) <= 1e-3 * um);                            // discretisation: steps of 1e-4 mm on a radius of rho
    CHECK(edge_moved_by(point, touch) == Approx(-touch.along).epsilon(1e-12));  // round-off: nothing is displaced
  }
  CHECK(beyond > 5);
}

namespace {

/// The mate's roll length where contact comes to the edge of a gear [mm], by the touches of a pair that is pushed apart.
PerGear<double> rolls_at_edges(const GearPair& pair, double apart) {
  FlankCondition condition;
  condition.misalignment.centre_distance = apart;
  const PathOfContact path(pair);
  const double b = 0.5 * pair.face_width;
  PerGear<double> at_edge{not_given, not_given};
  for (double phase = 0.05; phase < 1.0; phase += 0.1) {
    const std::vector<ContactPoint> points = contact_points(pair, path, {QuadratureRule::Midpoint, 1000}, phase, true, -b, b);
    const std::vector<FlankTouch> touches = FlankTouchSearch(pair, condition).at(points);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Member gear = points[i].tip_edge.gear, mate = gear == Member::Pinion ? Member::Wheel : Member::Pinion;
      if (points[i].tooth != points[i - 1].tooth || points[i - 1].tip_edge.gear != gear) continue;
      const auto to_edge = [&](std::size_t k) { return points[k].tip_edge.distance + edge_moved_by(points[k], touches[k]); };
      const auto roll = [&](std::size_t k) { return pair[mate].roll_length_at(touches[k].sides[0].radius[mate]); };
      const double here = to_edge(i), before = to_edge(i - 1);
      if ((here < 0.0) == (before < 0.0)) continue;
      at_edge[gear] = roll(i) - here / (here - before) * (roll(i) - roll(i - 1));
    }
  }
  return at_edge;
}

}  // namespace

TEST_CASE("Another centre distance moves the ends of the path of contact as in a pair that is made for it", "[core][contact][independent]") {
  const double sense = GENERATE(-1.0, 1.0);
  PairData data = pair_data(25, 50, 15 * deg);
  data.pinion.tip_rounding = data.wheel.tip_rounding = 0.15;
  const GearPair pair = make_gear_pair(data);
  struct End {
    double moved, off;
  };
  const auto ends = [&](double apart) {
    data.centre_distance = pair.centre_distance + apart;
    const GearPair made = make_gear_pair(data);
    const PerGear<double> roll = rolls_at_edges(pair, apart);
    const double pinion = made.path_start, wheel = made.path_length - made.path_end;
    return std::vector{End{pinion - pair.path_start, roll.wheel - pinion}, End{wheel - (pair.path_length - pair.path_end), roll.pinion - wheel}};
  };
  for (const double apart : {0.05, 0.1}) {
    for (const End& end : ends(apart * sense)) {
      CAPTURE(apart, sense, end.moved, end.off);
      CHECK(std::abs(end.moved) > 2.0 * apart);
      // model: second order, by the change of a radius of curvature along the way
      CHECK(std::abs(end.off) <= 2.0 * end.moved * end.moved / pair.path_start);
    }
  }
}
