#include "core/contact/path/contact_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/root.hpp"
#include "core/contact/path/passed_edge.hpp"
#include "core/gear/involute.hpp"

namespace flankwright {

namespace {

struct Node {
  double position;  ///< in the interval 0 .. 1
  double weight;    ///< of the interval
};

std::vector<Node> nodes(QuadratureRule rule) {
  switch (rule) {
    case QuadratureRule::Midpoint:
      return {{0.5, 1.0}};
    case QuadratureRule::Gauss2:
    case QuadratureRule::Graded: {
      const double d = 0.5 / std::sqrt(3.0);
      return {{0.5 - d, 0.5}, {0.5 + d, 0.5}};
    }
    case QuadratureRule::Gauss3: {
      const double d = 0.5 * std::sqrt(0.6);
      return {{0.5 - d, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + d, 5.0 / 18.0}};
    }
  }
  __builtin_unreachable();
}

/// Cuts [begin, end] at begin + (end - begin) cut(j/n); nothing where it is empty.
template <typename Cut>
void divide(double begin, double end, int n, Cut cut, std::vector<LineInterval>& intervals) {
  for (int j = 0; j < n; ++j) {
    const double a = begin + (end - begin) * cut(static_cast<double>(j) / n);
    const double b = begin + (end - begin) * cut(static_cast<double>(j + 1) / n);
    if (a < b) intervals.push_back({a, b});
  }
}

std::vector<LineInterval> graded_intervals(const PathOfContact& path, int n, double line_phase, double face_start, double face_end) {
  const auto towards_both_ends = [](double t) { return 0.5 * (1.0 - std::cos(units::pi * t)); };
  std::vector<LineInterval> intervals;
  if (path.slope == 0.0) {
    divide(face_start, face_end, n, towards_both_ends, intervals);
    return intervals;
  }
  const auto z_at = [&](double phase) { return std::clamp((phase - path.phase_at(line_phase, 0.0)) / path.slope, face_start, face_end); };
  // Where edges reach further than the extension, the mate's tip takes over from them there.
  std::array<double, 6> cuts{z_at(0.0),
                             z_at(path.edges.before),
                             z_at(path.before),
                             z_at(path.path_end()),
                             z_at(path.region_length - path.edges.beyond),
                             z_at(path.region_length)};
  if (path.before == path.edges.before) cuts[1] = cuts[0];
  if (path.beyond == path.edges.beyond) cuts[4] = cuts[5];
  std::sort(cuts.begin(), cuts.end());  // either sense of the lines
  const int extended = std::max(6, n / 2 + 3);
  const auto from_its_end = [](double t) { return t * (2.0 - t); };
  const auto from_its_start = [](double t) { return t * t; };
  divide(cuts[0], cuts[1], extended, from_its_end, intervals);
  divide(cuts[1], cuts[2], extended, from_its_end, intervals);
  divide(cuts[2], cuts[3], n, towards_both_ends, intervals);
  divide(cuts[3], cuts[4], extended, from_its_start, intervals);
  divide(cuts[4], cuts[5], extended, from_its_start, intervals);
  return intervals;
}

/// Polar angle of a flank at roll length rho, about its gear's centre and from the line of centres, when the undisturbed flanks would touch
/// at its roll length `on_line`: -alpha_wt on the line of action, from there turned by the gear's rotation.
double polar_angle(const GearPair& pair, const Gear& gear, double on_line, double rho) {
  return -pair.working_transverse_pressure_angle + (on_line - rho) / gear.base_radius + std::atan(rho / gear.base_radius);
}

struct Polar {
  double radius, angle;
};

/// A gear's flank at roll length rho about its mate's centre.
Polar about_mate(const GearPair& pair, const Gear& gear, double on_line, double rho) {
  const double radius = std::hypot(gear.base_radius, rho), angle = polar_angle(pair, gear, on_line, rho);
  const double x = pair.centre_distance - radius * std::cos(angle), y = -radius * std::sin(angle);
  return {std::hypot(x, y), std::atan2(y, x)};
}

/// Where flanks meet outside A .. E, transverse section.
struct EdgeContact {
  double roll, mate_roll;  ///< [mm]
  double clearance;        ///< by which the mate would have to turn, along its base tangent [mm]
};

/// A point of a flank, at its roll length rho and where the mate sees it, against the mate's flank, both as undisturbed flanks turn.
EdgeContact meet(const GearPair& pair, const Gear& mate, double on_line, double rho, const Polar& polar) {
  const double mate_roll = mate.roll_length_at(polar.radius);
  return {rho, mate_roll, mate.base_radius * (polar.angle - polar_angle(pair, mate, pair.path_length - on_line, mate_roll))};
}

double lower_end(const Gear& gear) { return std::max(gear.base_radius, gear.form_radius); }

/// The tip edge of `gear` against its mate's flank, `gear` where the undisturbed flanks would touch at its roll length `on_line`.
std::optional<EdgeContact> tip_contact(const GearPair& pair, const Gear& gear, const Gear& mate, double on_line) {
  const double rho = gear.roll_length_at(gear.tip_form_radius);
  const Polar polar = about_mate(pair, gear, on_line, rho);
  if (polar.radius <= lower_end(mate) || polar.radius > mate.tip_form_radius) return std::nullopt;
  return meet(pair, mate, on_line, rho, polar);
}

/// The pinion's flank against the wheel's where the path ends at a form circle, as the wheel turns: with the pinion's edge (its lower end before A, its tip
/// beyond E) where that is on the wheel's flank, else where the pinion's flank passes the wheel's edge (its tip before A, its lower end beyond E).
/// @param on_line  pinion roll length of the undisturbed contact
std::optional<EdgeContact> interfering_contact(const GearPair& pair, bool before, double on_line) {
  const Gear &pinion = pair.pinion, &wheel = pair.wheel;
  const double lower = pinion.roll_length_at(lower_end(pinion)), upper = pinion.roll_length_at(pinion.tip_form_radius);
  const double edge = before ? lower : upper, other = before ? upper : lower;
  const Polar polar = about_mate(pair, pinion, on_line, edge);
  const bool inside = polar.radius >= lower_end(wheel) && polar.radius <= wheel.tip_form_radius;
  if (inside) return meet(pair, wheel, on_line, edge, polar);
  // Outwards along the pinion's flank the wheel's radius falls.
  const double circle = before ? wheel.tip_form_radius : lower_end(wheel);
  const auto excess = [&](double rho) { return about_mate(pair, pinion, on_line, rho).radius - circle; };
  const double at_edge = excess(edge), at_other = excess(other);
  if ((at_edge > 0.0) != before || (at_other > 0.0) == before) return std::nullopt;
  const double tolerance = 4.0 * std::numeric_limits<double>::epsilon() * upper;
  const double rho = bracketed_root(excess, edge, at_edge, other, at_other, tolerance).x;
  Polar crossing = about_mate(pair, pinion, on_line, rho);
  crossing.radius = circle;
  return meet(pair, wheel, on_line, rho, crossing);
}

/// Outside A .. E, on either side.
/// @param on_line  pinion roll length of the undisturbed contact
std::optional<EdgeContact> edge_contact(const GearPair& pair, bool before, double on_line) {
  if ((before ? pair.pinion : pair.wheel).fillet_interference) return interfering_contact(pair, before, on_line);
  if (!before) return tip_contact(pair, pair.pinion, pair.wheel, on_line);
  auto contact = tip_contact(pair, pair.wheel, pair.pinion, pair.path_length - on_line);
  if (contact) std::swap(contact->roll, contact->mate_roll);
  return contact;
}

/// Arc of the involute from a roll length to the start of the tip rounding [mm].
double to_tip_form(const Gear& gear, double roll) {
  const double end = gear.roll_length_at(gear.tip_form_radius);
  return (end - roll) * (end + roll) / (2.0 * gear.base_radius);
}

/// The nearest edge between A and E.
TipEdge nearest_tip_edge(const GearPair& pair, double pinion_roll, double wheel_roll) {
  const TipEdge of_pinion{Member::Pinion, pair.pinion.tip_edge_radius, to_tip_form(pair.pinion, pinion_roll)};
  const TipEdge of_wheel{Member::Wheel, pair.wheel.tip_edge_radius, to_tip_form(pair.wheel, wheel_roll)};
  return of_wheel.distance < of_pinion.distance ? of_wheel : of_pinion;
}

/// Outside A .. E an edge lies where two parabolas have the clearance of the sharp form circle.
void set_passed_edge(const GearPair& pair, Member gear, ContactPoint& point) {
  const double rho = pair[gear].tip_edge_radius, radius = point.relative_radius;
  if (!(radius > 0.0)) return;
  const double beyond = PassedEdge::beyond(point.clearance, radius);
  point.tip_edge = {gear, rho, -beyond, PassedEdge::at(beyond, radius, rho).rounded_off};
  point.clearance -= point.tip_edge.rounded_off;
}

/// Geometry at a phase; false where no contact can be.
bool locate(const GearPair& pair, const PathOfContact& path, bool with_extended_region, ContactPoint& point) {
  const double rho1 = path.roll_at(point.phase);
  if (rho1 >= pair.path_start && rho1 <= pair.path_end) {
    set_rolls(pair, rho1, pair.path_length - rho1, point);
    return point.relative_radius > 0.0;
  }
  if (!with_extended_region) return false;
  const auto contact = edge_contact(pair, rho1 < pair.path_start, rho1);
  if (!contact) return false;
  set_rolls(pair, contact->roll, contact->mate_roll, point);
  point.clearance = contact->clearance * std::cos(pair.base_helix_angle);
  const bool before = rho1 < pair.path_start;
  // An interfering flank meets the mate with its lower end, no tip edge.
  if (!(before ? pair.pinion : pair.wheel).fillet_interference) set_passed_edge(pair, before ? Member::Wheel : Member::Pinion, point);
  return point.relative_radius > 0.0;
}

}  // namespace

void set_rolls(const GearPair& pair, double pinion_roll, double wheel_roll, ContactPoint& point) {
  const double cos_base_helix = std::cos(pair.base_helix_angle);
  const auto side = [&](const Gear& gear, double rho, double& radius, double& depth, double& tip_distance) {
    radius = std::hypot(gear.base_radius, rho);
    const double cos_alpha = gear.base_radius / radius;
    depth = 0.5 * gear.tooth_thickness_at(radius) * cos_base_helix / cos_alpha;
    tip_distance = std::max(0.0, gear.tip_radius - radius) / cos_alpha;
  };
  side(pair.pinion, pinion_roll, point.pinion_radius, point.pinion_depth, point.pinion_tip_distance);
  side(pair.wheel, wheel_roll, point.wheel_radius, point.wheel_depth, point.wheel_tip_distance);
  point.relative_radius = pinion_roll * wheel_roll / (pinion_roll + wheel_roll) / cos_base_helix;
  point.tip_edge = nearest_tip_edge(pair, pinion_roll, wheel_roll);
}

std::vector<LineInterval> line_intervals(const PathOfContact& path, const Quadrature& quadrature, double line_phase, double face_start,
                                         double face_end) {
  if (quadrature.rule == QuadratureRule::Graded) {
    return graded_intervals(path, quadrature.intervals, line_phase, face_start, face_end);
  }
  std::vector<LineInterval> intervals;
  const double width = (face_end - face_start) / quadrature.intervals;
  for (int i = 0; i < quadrature.intervals; ++i) intervals.push_back({face_start + i * width, face_start + (i + 1) * width});
  return intervals;
}

std::optional<ContactPoint> contact_point(const GearPair& pair, const PathOfContact& path, double line_phase, int tooth, double z,
                                          bool with_extended_region) {
  ContactPoint point;
  point.tooth = tooth;
  point.z = z;
  point.phase = path.phase_at(line_phase + tooth, z);
  const bool inside = point.phase >= 0.0 && point.phase <= path.region_length;
  if (!inside || !locate(pair, path, with_extended_region, point)) return std::nullopt;
  return point;
}

std::vector<ContactPoint> contact_points(const GearPair& pair, const PathOfContact& path, const Quadrature& quadrature, double line_phase,
                                         bool with_extended_region, double face_start, double face_end) {
  const std::vector<Node> rule = nodes(quadrature.rule);
  const double cos_base_helix = std::cos(pair.base_helix_angle);
  const int first = static_cast<int>(std::floor(-line_phase));
  const int last = static_cast<int>(std::ceil(path.last_line_phase() - line_phase));
  std::vector<ContactPoint> points;
  for (int tooth = first; tooth <= last; ++tooth) {
    int interval = -1;
    for (const LineInterval& part : line_intervals(path, quadrature, line_phase + tooth, face_start, face_end)) {
      ++interval;
      for (const Node& node : rule) {
        const double width = part.end - part.begin;
        auto point = contact_point(pair, path, line_phase, tooth, part.begin + node.position * width, with_extended_region);
        if (!point) continue;
        point->weight = node.weight * width / cos_base_helix;
        if (quadrature.rule == QuadratureRule::Graded) point->interval = interval;
        points.push_back(*point);
      }
    }
  }
  return points;
}

}  // namespace flankwright
