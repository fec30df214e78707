#include "core/contact/contact_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/gear/involute.hpp"

namespace flankwright {

namespace {

struct Node {
  double position;  ///< in the interval 0 .. 1
  double weight;    ///< of the interval
};

std::vector<Node> nodes(QuadratureRule rule) {
  switch (rule) {
    case QuadratureRule::Midpoint: return {{0.5, 1.0}};
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

/// Cuts [begin, end] at begin + (end - begin) cut(j/n).
template <typename Cut>
void divide(double begin, double end, int n, Cut cut, std::vector<LineInterval>& intervals) {
  for (int j = 0; j < n; ++j) {
    const double a = begin + (end - begin) * cut(static_cast<double>(j) / n);
    const double b = begin + (end - begin) * cut(static_cast<double>(j + 1) / n);
    if (a < b) intervals.push_back({a, b});
  }
}

std::vector<LineInterval> graded_intervals(const PathOfContact& path, int n, double line_phase, double face_start,
                                           double face_end) {
  const auto towards_both_ends = [](double t) { return 0.5 * (1.0 - std::cos(units::pi * t)); };
  std::vector<LineInterval> intervals;
  if (path.slope == 0.0) {
    divide(face_start, face_end, n, towards_both_ends, intervals);
    return intervals;
  }
  const auto z_at = [&](double phase) {
    return std::clamp((phase - path.phase_at(line_phase, 0.0)) / path.slope, face_start, face_end);
  };
  std::array<double, 4> cuts{z_at(0.0), z_at(PathOfContact::extension), z_at(path.region_length - PathOfContact::extension),
                             z_at(path.region_length)};
  std::sort(cuts.begin(), cuts.end());  // either sense of the lines
  const int extended = std::max(2, n / 2);
  if (cuts[0] < cuts[1]) divide(cuts[0], cuts[1], extended, [](double t) { return t * (2.0 - t); }, intervals);
  if (cuts[1] < cuts[2]) divide(cuts[1], cuts[2], n, towards_both_ends, intervals);
  if (cuts[2] < cuts[3]) divide(cuts[2], cuts[3], extended, [](double t) { return t * t; }, intervals);
  return intervals;
}

/// Where a tip edge meets the mate's flank, transverse section.
struct TipContact {
  double mate_roll;  ///< roll length of the mate's flank at the tip's radius [mm]
  double clearance;  ///< along the base tangent [mm]
};

/// The edge of `tip` at the instant at which the undisturbed flanks would touch at roll `tip_roll` > its tip's on the line of
/// action, against the flank of `mate` (undisturbed roll `mate_roll`). Both flanks turned by their own rotation: the polar angle of
/// the flank at roll length rho is -alpha_wt + (roll* - rho)/r_b + atan(rho/r_b) when roll* is on the line of action.
std::optional<TipContact> tip_contact(const GearPair& pair, const Gear& tip, const Gear& mate, double tip_roll,
                                      double mate_roll) {
  const double alpha = pair.working_transverse_pressure_angle;
  const auto polar_angle = [alpha](const Gear& gear, double on_line, double rho) {
    return -alpha + (on_line - rho) / gear.base_radius + std::atan(rho / gear.base_radius);
  };
  const double angle = polar_angle(tip, tip_roll, tip.roll_length_at(tip.tip_radius));
  const double x = pair.centre_distance - tip.tip_radius * std::cos(angle), y = -tip.tip_radius * std::sin(angle);
  const double radius = std::hypot(x, y);
  if (radius <= std::max(mate.base_radius, mate.form_radius) || radius > mate.tip_radius) return std::nullopt;
  const double rho = mate.roll_length_at(radius);
  return TipContact{rho, mate.base_radius * (std::atan2(y, x) - polar_angle(mate, mate_roll, rho))};
}

/// Geometry at a phase; false where no contact can be.
bool locate(const GearPair& pair, const PathOfContact& path, bool with_extended_region, ContactPoint& point) {
  const double rho1 = path.roll_at(point.phase), rho2 = pair.path_length - rho1;
  if (rho1 >= pair.path_start && rho1 <= pair.path_end) {
    set_rolls(pair, rho1, rho2, point);
    return point.relative_radius > 0.0;
  }
  if (!with_extended_region) return false;
  const double cos_base_helix = std::cos(pair.base_helix_angle);
  if (rho1 < pair.path_start) {
    if (pair.pinion.fillet_interference) return false;
    const auto contact = tip_contact(pair, pair.wheel, pair.pinion, rho2, rho1);
    if (!contact) return false;
    set_rolls(pair, contact->mate_roll, pair.wheel.roll_length_at(pair.wheel.tip_radius), point);
    point.clearance = contact->clearance * cos_base_helix;
  } else {
    if (pair.wheel.fillet_interference) return false;
    const auto contact = tip_contact(pair, pair.pinion, pair.wheel, rho1, rho2);
    if (!contact) return false;
    set_rolls(pair, pair.pinion.roll_length_at(pair.pinion.tip_radius), contact->mate_roll, point);
    point.clearance = contact->clearance * cos_base_helix;
  }
  return true;
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
}

std::vector<LineInterval> line_intervals(const PathOfContact& path, const Quadrature& quadrature, double line_phase,
                                         double face_start, double face_end) {
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

std::vector<ContactPoint> contact_points(const GearPair& pair, const PathOfContact& path, const Quadrature& quadrature,
                                         double line_phase, bool with_extended_region, double face_start, double face_end) {
  const std::vector<Node> rule = nodes(quadrature.rule);
  const double cos_base_helix = std::cos(pair.base_helix_angle);
  const int first = static_cast<int>(std::floor(-line_phase));
  const int last = static_cast<int>(std::ceil(path.last_line_phase() - line_phase));
  std::vector<ContactPoint> points;
  for (int tooth = first; tooth <= last; ++tooth) {
    for (const LineInterval& part : line_intervals(path, quadrature, line_phase + tooth, face_start, face_end)) {
      for (const Node& node : rule) {
        const double width = part.end - part.begin;
        auto point = contact_point(pair, path, line_phase, tooth, part.begin + node.position * width, with_extended_region);
        if (!point) continue;
        point->weight = node.weight * width / cos_base_helix;
        points.push_back(*point);
      }
    }
  }
  return points;
}

}  // namespace flankwright
