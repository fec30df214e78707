#include "core/contact/contact_points.hpp"

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
    case QuadratureRule::Gauss2: {
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

/// Fills radii, curvature and clearance of a point from its roll lengths on both gears.
void place(const GearPair& pair, double pinion_roll, double wheel_roll, ContactPoint& point) {
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

/// Geometry at a phase; false where no contact can be.
bool locate(const GearPair& pair, const PathOfContact& path, bool with_extended_region, ContactPoint& point) {
  const double rho1 = path.roll_at(point.phase), rho2 = pair.path_length - rho1;
  if (rho1 >= pair.path_start && rho1 <= pair.path_end) {
    place(pair, rho1, rho2, point);
    return point.relative_radius > 0.0;
  }
  if (!with_extended_region) return false;
  const double cos_base_helix = std::cos(pair.base_helix_angle);
  if (rho1 < pair.path_start) {
    if (pair.pinion.fillet_interference) return false;
    const auto contact = tip_contact(pair, pair.wheel, pair.pinion, rho2, rho1);
    if (!contact) return false;
    place(pair, contact->mate_roll, pair.wheel.roll_length_at(pair.wheel.tip_radius), point);
    point.clearance = contact->clearance * cos_base_helix;
  } else {
    if (pair.wheel.fillet_interference) return false;
    const auto contact = tip_contact(pair, pair.pinion, pair.wheel, rho1, rho2);
    if (!contact) return false;
    place(pair, pair.pinion.roll_length_at(pair.pinion.tip_radius), contact->mate_roll, point);
    point.clearance = contact->clearance * cos_base_helix;
  }
  return true;
}

}  // namespace

std::vector<ContactPoint> contact_points(const GearPair& pair, const PathOfContact& path, const Quadrature& quadrature,
                                         double line_phase, bool with_extended_region, double face_start, double face_end) {
  const std::vector<Node> rule = nodes(quadrature.rule);
  const double interval = (face_end - face_start) / quadrature.intervals;
  const double cos_base_helix = std::cos(pair.base_helix_angle);
  const int first = static_cast<int>(std::floor(-line_phase));
  const int last = static_cast<int>(std::ceil(path.last_line_phase() - line_phase));
  std::vector<ContactPoint> points;
  for (int tooth = first; tooth <= last; ++tooth) {
    for (int i = 0; i < quadrature.intervals; ++i) {
      for (const Node& node : rule) {
        ContactPoint point;
        point.tooth = tooth;
        point.z = face_start + (i + node.position) * interval;
        point.phase = path.phase_at(line_phase + tooth, point.z);
        point.weight = node.weight * interval / cos_base_helix;
        if (point.phase < 0.0 || point.phase > path.region_length) continue;
        if (locate(pair, path, with_extended_region, point)) points.push_back(point);
      }
    }
  }
  return points;
}

}  // namespace flankwright
