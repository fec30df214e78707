#include "core/contact/path/contact_points.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/haddad_18_54.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::deg;
using units::pi;

namespace {

/// Points of one mesh position over the common face width.
std::vector<ContactPoint> points_at(const GearPair& pair, double line_phase, int intervals, bool extended = true,
                                    QuadratureRule rule = QuadratureRule::Midpoint) {
  const double b = 0.5 * pair.face_width;
  return contact_points(pair, PathOfContact(pair), {rule, intervals}, line_phase, extended, -b, b);
}

/// Pair 0 alone, spur, mid-face: the point at a distance beyond the end (or before the start) of the path.
ContactPoint beyond(const GearPair& pair, double distance, bool at_end) {
  const PathOfContact path(pair);
  const double roll = at_end ? pair.path_end + distance : pair.path_start - distance;
  const double phase = (roll - path.roll_at_start) / path.base_pitch;
  for (const ContactPoint& point : points_at(pair, phase + std::abs(path.slope) * path.half_face, 1)) {
    if (point.tooth == 0) return point;
  }
  FAIL("no point there");
  return {};
}

}  // namespace

TEST_CASE("The path of contact counts base pitches as Haddad does", "[core][contact][reference]") {
  namespace published = reference::haddad_18_54;
  const GearPair pair = make_gear_pair(published::pair_data());
  const PathOfContact path(pair);
  CHECK(std::abs(path.region_length - published::region_length) <= published::half_digit_5);
  CHECK(std::abs(path.roll_at(published::path_start) - published::roll_at_path_start) <= published::half_digit_4);
  CHECK(std::abs(path.roll_at(published::path_end) - pair.path_end) <= published::half_digit_5 * path.base_pitch);
  // rho_1 of a point follows its phase; the relative radius is that of the two involutes over cos(beta_b), eq. 2.15.
  for (const ContactPoint& point : points_at(pair, 1.3, 15, false)) {
    const double rho1 = published::roll_at_path_start + (point.phase - published::path_start) * path.base_pitch;
    const double rho2 = published::tangent_to_tangent - rho1;
    const double expected = rho1 * rho2 / (rho1 + rho2) / std::cos(pair.base_helix_angle);
    CHECK(std::abs(point.relative_radius - expected) <= published::half_digit_3);
    CHECK(std::abs(std::hypot(pair.pinion.base_radius, rho1) - point.pinion_radius) <= published::half_digit_3);
    CHECK(std::abs(std::hypot(pair.wheel.base_radius, rho2) - point.wheel_radius) <= published::half_digit_3);
    CHECK(point.clearance == 0.0);
  }
}

TEST_CASE("At phi1 = 0 pair 0 is at the pitch point in mid face and moves a base pitch per pinion pitch", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(21, 50, GENERATE(0.0, 0.3), 0.2));
  const PathOfContact path(pair);
  CHECK(std::abs(path.roll_at(path.phase_at(path.line_phase_at(0.0, pair), 0.0)) - pair.pitch_point) <= 1e-12);
  CHECK(std::abs(path.line_phase_at(2 * pi / 21, pair) - path.line_phase_at(0.0, pair) - 1.0) <= 1e-14);
  // The leading end of a line that has just left is where the region ends.
  const double trailing = path.slope > 0.0 ? -path.half_face : path.half_face;
  CHECK(std::abs(path.phase_at(path.last_line_phase(), trailing) - path.region_length) <= 1e-13);
}

TEST_CASE("The weights of the contact points add up to the length of the contact lines", "[core][contact][closed-form]") {
  const double beta = GENERATE(0.0, 12 * deg, 31 * deg);
  const QuadratureRule rule = GENERATE(QuadratureRule::Gauss2, QuadratureRule::Gauss3, QuadratureRule::Midpoint);
  const bool extended = GENERATE(true, false);
  const GearPair pair = make_gear_pair(pair_data(24, 60, beta, 0.1));
  const PathOfContact path(pair);
  const int intervals = 400;
  const double margin = extended ? 0.0 : PathOfContact::extension;
  for (double line_phase = 0.013; line_phase < 1.0; line_phase += 0.09) {
    double found = 0.0;
    for (const ContactPoint& point : points_at(pair, line_phase, intervals, extended, rule)) found += point.weight;
    // Each line: the part of the face at which its phase is inside the region.
    double expected = 0.0;
    int ends = 0;
    for (int k = -6; k <= 6; ++k) {
      const double from = path.phase_at(line_phase + k, -path.half_face), to = path.phase_at(line_phase + k, path.half_face);
      const double low = std::min(from, to), high = std::max(from, to);
      const double inside_low = std::max(low, margin), inside_high = std::min(high, path.region_length - margin);
      if (inside_high < inside_low) continue;
      expected += (beta == 0.0 ? 1.0 : (inside_high - inside_low) / (high - low)) * pair.face_width;
      ends += (inside_low > low) + (inside_high < high);
    }
    const double cos_b = std::cos(pair.base_helix_angle);
    // discretisation: a line that ends inside an interval gains or loses no more than the interval
    CHECK(std::abs(found - expected / cos_b) <= (ends + 1e-9) * pair.face_width / intervals / cos_b);
  }
}

TEST_CASE("Graded intervals end where a line does: weights add up to its length exactly, points move with it", "[core][contact][closed-form]") {
  const double beta = GENERATE(12 * deg, -31 * deg);
  const bool extended = GENERATE(true, false);
  PairData data = pair_data(24, 60, std::abs(beta), 0.1);
  if (beta < 0.0) data.pinion_hand = Hand::Left;
  const GearPair pair = make_gear_pair(data);
  const PathOfContact path(pair);
  const double margin = extended ? 0.0 : PathOfContact::extension;
  constexpr double kRoundOff = 1e-12;
  for (double line_phase = 0.013; line_phase < 1.0; line_phase += 0.09) {
    double found = 0.0, expected = 0.0;
    const auto points = points_at(pair, line_phase, 4, extended, QuadratureRule::Graded);
    for (const ContactPoint& point : points) found += point.weight;
    for (int k = -6; k <= 6; ++k) {
      const double a = path.phase_at(line_phase + k, -path.half_face), b = path.phase_at(line_phase + k, path.half_face);
      const double low = std::max(std::min(a, b), margin), high = std::min(std::max(a, b), path.region_length - margin);
      expected += std::max(0.0, high - low) / std::abs(a - b) * pair.face_width / std::cos(pair.base_helix_angle);
    }
    CHECK(found == Approx(expected).epsilon(kRoundOff));
    CHECK(std::is_sorted(points.begin(), points.end(),
                         [](const ContactPoint& p, const ContactPoint& q) { return p.tooth != q.tooth ? p.tooth < q.tooth : p.z < q.z; }));
    // A line that turns with the gear keeps its points' places on the path wherever both its ends are the path's.
    const double step = 1e-3;
    const auto later = points_at(pair, line_phase + step, 4, extended, QuadratureRule::Graded);
    if (later.size() != points.size()) continue;
    for (std::size_t i = 0; i < points.size(); ++i) {
      CHECK(std::abs(later[i].phase - points[i].phase) <= step * (1.0 + kRoundOff));
      CHECK(std::abs(later[i].z - points[i].z) <= step / std::abs(path.slope) * (1.0 + kRoundOff));
    }
  }
}

TEST_CASE("Next to the theoretical path the clearance is the parabola of the relative curvature", "[core][contact][closed-form]") {
  // A tip that meets the mate a distance d off the end of the path is the point of the (undisturbed, touching) flank at
  // arc length rho d/r_b from the contact point, so that c = (1/rho_1 + 1/rho_2) (rho d/r_b)^2/2 transversely: it
  // starts with zero slope and grows both ways.
  const bool at_end = GENERATE(true, false);
  const double beta = GENERATE(0.0, 20 * deg);
  const GearPair pair = make_gear_pair(pair_data(27, 44, beta));
  const double rho1 = at_end ? pair.path_end : pair.path_start, rho2 = pair.path_length - rho1;
  const double ratio = at_end ? rho1 / pair.pinion.base_radius : rho2 / pair.wheel.base_radius;
  const double curvature = (1 / rho1 + 1 / rho2) * ratio * ratio * std::cos(pair.base_helix_angle);
  double last = 0.0;
  for (double d = 1e-3; d < PathOfContact::extension * pair.transverse_base_pitch; d *= 1.6) {
    const double c = beyond(pair, d, at_end).clearance;
    CAPTURE(d);
    CHECK(c > last);
    last = c;
    // model: next order of the series, with d over the smaller radius of curvature or so; round-off: eps times the
    // radii
    CHECK(std::abs(c - 0.5 * curvature * d * d) <= 0.5 * curvature * d * d * (1.5 * d / std::min(rho1, rho2)) + 1e-13);
  }
  CHECK(beyond(pair, -1e-6, at_end).clearance == 0.0);
  CHECK(beyond(pair, 1e-6, at_end).clearance <= 1e-12);
}

TEST_CASE("The clearance is what the unloaded contact of a spur pair turns back by", "[core][contact][independent]") {
  const bool at_end = GENERATE(true, false);
  const GearPair pair = make_gear_pair(pair_data(22, 51, 0.0, 0.2, 0.1));
  const FlankAssembly scene = scene_of(pair);
  for (const double d : {0.3, 1.0, 2.0, 2.9}) {
    const ContactPoint point = beyond(pair, d, at_end);
    const double roll = at_end ? pair.path_end + d : pair.path_start - d;
    const ToothContact contact = find_tooth_contact(scene, 0, (roll - pair.pitch_point) / pair.pinion.base_radius);
    CAPTURE(at_end, d);
    CHECK(contact.kind == (at_end ? ContactKind::PinionTip : ContactKind::WheelTip));
    const double turned_back = -contact.transmission_error * pair.wheel.base_radius;
    if (at_end) {
      CHECK(std::abs(turned_back - point.clearance) <= 1e-11);  // round-off: both turn the wheel
      CHECK(std::abs(contact.wheel_radius - point.wheel_radius) <= 1e-9);
    } else {
      // model: one turns the wheel with its tip, the other the pinion under the tip. The tip that lags by c stands a
      // distance c further off the path's start: c(d + c) = c + c'(d) c, with c = k d^2/2 more by the part k d.
      const double ratio = pair.wheel.roll_length_at(pair.wheel.tip_radius) / pair.wheel.base_radius;
      const double k = (1 / pair.path_start + 1 / (pair.path_length - pair.path_start)) * ratio * ratio;
      CHECK(turned_back >= point.clearance);
      CHECK(turned_back <= point.clearance * (1 + 1.5 * k * d));
      CHECK(std::abs(contact.pinion_radius - point.pinion_radius) <= point.clearance);
    }
  }
}

TEST_CASE("Depths and tip distances are those of the tooth at the point", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(24, 60, 18 * deg, 0.2));
  for (const ContactPoint& point : points_at(pair, 1.7, 24)) {
    CHECK(point.pinion_tip_distance >= 0.0);
    CHECK(point.wheel_tip_distance >= 0.0);
    if (point.clearance > 0.0) CHECK(std::min(point.pinion_tip_distance, point.wheel_tip_distance) <= 1e-9);
    // Depth: from the flank to the tooth's centre line along the flank's normal; half the arc, seen under the normal.
    const double cos_alpha = pair.pinion.base_radius / point.pinion_radius;
    const double half_arc = 0.5 * pair.pinion.tooth_thickness_at(point.pinion_radius);
    CHECK(std::abs(point.pinion_depth * cos_alpha / std::cos(pair.base_helix_angle) - half_arc) <= 1e-12);
  }
}

TEST_CASE("Where the path ends at a form circle the flank's lower end meets the mate, further out the mate's tip", "[core][contact][independent]") {
  const bool at_end = GENERATE(false, true);
  const GearPair pair = make_gear_pair(at_end ? pair_data(60, 10, 0.0) : pair_data(10, 60, 0.0));
  REQUIRE((at_end ? pair.wheel : pair.pinion).fillet_interference);
  const FlankAssembly scene = scene_of(pair);
  const PathOfContact path(pair);
  const double reach = ((at_end ? path.beyond : path.before) - PathOfContact::extension) * path.base_pitch;
  REQUIRE(reach > 0.2 * path.base_pitch);
  constexpr double kRoundOff = 1e-11;  // mm: of wheel angles times r_b2; both turn the wheel
  double last = 0.0;
  for (const double part : {0.01, 0.3, 0.7, 0.99, 0.999999, 1.000001, 1.01, 1.2, 1.4}) {
    const double d = part * reach;
    const ContactPoint point = beyond(pair, d, at_end);
    const double roll = at_end ? pair.path_end + d : pair.path_start - d;
    const ToothContact contact = find_tooth_contact(scene, 0, (roll - pair.pitch_point) / pair.pinion.base_radius);
    CAPTURE(at_end, part, point.clearance);
    // The corner itself: the edge that the wheel turns towards comes there a clearance earlier or later.
    const bool near_corner = std::abs(part - 1.0) < 0.001;
    if (!near_corner) {
      const ContactKind edge = at_end ? ContactKind::WheelRoot : ContactKind::PinionRoot,
                        tip = at_end ? ContactKind::PinionTip : ContactKind::WheelTip;
      CHECK(contact.kind == (part < 1.0 ? edge : tip));
    }
    CHECK(std::abs(point.clearance + contact.transmission_error * pair.wheel.base_radius) <= kRoundOff);
    CHECK(std::abs(point.wheel_radius - contact.wheel_radius) <= 1e-9);  // mm: of a place, the angle's round-off over a flat slope
    CHECK(point.relative_radius > 0.0);
    CHECK(point.clearance > 0.0);
    // Where the tip takes over from the edge there is no step: flanks part by less than the line advances, 2e-6 of the reach.
    if (part > 1.0 && near_corner) CHECK(std::abs(point.clearance - last) <= 2e-6 * reach);
    last = point.clearance;
  }
}

TEST_CASE("Graded lines are cut where the mate's tip takes over from an edge", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(10, 60, 20 * deg));
  const PathOfContact path(pair);
  REQUIRE(path.before > PathOfContact::extension);
  REQUIRE(path.beyond == PathOfContact::extension);
  const double b = 0.5 * pair.face_width, round_off = 1e-12 * b;
  int found = 0;
  for (double line_phase = 0.05; line_phase < path.last_line_phase(); line_phase += 0.1) {
    const auto intervals = line_intervals(path, {QuadratureRule::Graded, 4}, line_phase, -b, b);
    for (const double phase : {PathOfContact::extension, path.before, path.path_end()}) {
      const double z = (phase - path.phase_at(line_phase, 0.0)) / path.slope;
      if (std::abs(z) >= b) continue;
      CHECK(std::any_of(intervals.begin(), intervals.end(), [&](const LineInterval& part) { return std::abs(part.end - z) <= round_off; }));
      ++found;
    }
    for (std::size_t i = 1; i < intervals.size(); ++i) CHECK(std::abs(intervals[i].begin - intervals[i - 1].end) <= round_off);
  }
  CHECK(found >= 10);
}
