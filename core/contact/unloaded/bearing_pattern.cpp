#include "core/contact/unloaded/bearing_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/base/root.hpp"

namespace flankwright {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double angle_tolerance = 1e-7;  // rad of phi1: a minimum's value then errs by 1e-14 of its curvature

/// Transmission error of the mesh over the pitch analysed, linear between positions and transfer points.
class Envelope {
 public:
  Envelope(const FlankAssembly& assembly, const UnloadedMesh& mesh) {
    for (std::size_t i = 0; i < mesh.phi1.size(); ++i) nodes_.emplace_back(mesh.phi1[i], mesh.transmission_error[i]);
    for (const Transfer& t : mesh.transfers) nodes_.emplace_back(t.phi1, t.transmission_error);
    // The position that closes the pitch: with pitch deviations it is not the first one again.
    const double end = units::pi / assembly.pinion_teeth;
    double last = -infinity;
    const auto consider = [&](int tooth) {
      const ToothContact contact = find_tooth_contact(assembly, tooth, end);
      if (contact.exists()) last = std::max(last, contact.transmission_error);
    };
    for (const PairCurve& pair : mesh.pairs) consider(pair.tooth);
    if (!mesh.transfers.empty()) consider(mesh.transfers.back().to_tooth);  // may have entered since the last position
    nodes_.emplace_back(end, last);
    std::sort(nodes_.begin(), nodes_.end());
  }

  double start() const { return nodes_.front().first; }
  double end() const { return nodes_.back().first; }

  /// delta_phi2 [rad], with its derivative with respect to phi1.
  Dual<1> at(double phi1) const {
    const auto above = std::lower_bound(nodes_.begin() + 1, nodes_.end() - 1, std::pair(phi1, -infinity));
    const auto& [x0, y0] = *(above - 1);
    const auto& [x1, y1] = *above;
    const double slope = x1 > x0 ? (y1 - y0) / (x1 - x0) : 0.0;
    return y0 + slope * (Dual<1>::variable(phi1, 0) - x0);
  }

 private:
  std::vector<std::pair<double, double>> nodes_;  ///< phi1, delta_phi2
};

/// The flank that carries the grid, its mate, and how one looks from the other.
class Passage {
 public:
  Passage(const FlankAssembly& assembly, const UnloadedMesh& mesh, Member member)
      : assembly_(assembly),
        envelope_(assembly, mesh),
        on_pinion_(member == Member::Pinion),
        self_(on_pinion_ ? assembly.pinion : assembly.wheel),
        mate_(on_pinion_ ? assembly.wheel : assembly.pinion),
        normal_per_angle_(mate_.base_radius / std::hypot(1.0, mate_.helix_rate * mate_.base_radius)) {}

  /// Smallest separation over the pitch analysed, whichever tooth brings it [mm].
  double smallest_separation(double rho, double z) const {
    const double offset = (on_pinion_ ? -1.0 : 1.0) * assembly_.wheel_centre.z();
    if (!mate_.face.holds(z + offset)) return infinity;
    const double pitch = 2.0 * units::pi / assembly_.pinion_teeth;
    const double undisturbed = self_.frame.pinion_turn * ((rho - self_.frame.pitch_roll) / self_.base_radius - self_.helix_rate * z);
    const int nearest = static_cast<int>(std::lround(undisturbed / pitch));
    double smallest = infinity;
    for (int tooth = nearest - 1; tooth <= nearest + 1; ++tooth) {
      smallest = std::min(smallest, PointPath{*this, rho, z, tooth}.smallest_separation(undisturbed - tooth * pitch));
    }
    return smallest;
  }

 private:
  /// One point of the flank of one tooth as the pinion turns.
  struct PointPath {
    const Passage& passage;
    double rho, z;
    int tooth;

    Point3<Dual<1>> in_mate(double phi1) const;
    Dual<1> separation(double phi1) const;
    std::optional<std::pair<double, double>> facing(double undisturbed) const;
    double smallest_separation(double undisturbed) const;
  };

  /// Rotation of a gear in its own frame, with its derivative with respect to phi1.
  Dual<1> rotation(bool of_pinion, double phi1, int tooth) const {
    const Dual<1> pinion = Dual<1>::variable(phi1, 0);
    if (of_pinion) return pinion + tooth * 2.0 * units::pi / assembly_.pinion_teeth;
    return -(assembly_.speed_ratio() * pinion + envelope_.at(phi1)) - tooth * 2.0 * units::pi / assembly_.wheel_teeth;
  }

  const FlankAssembly& assembly_;
  Envelope envelope_;
  bool on_pinion_;
  const Flank &self_, &mate_;
  double normal_per_angle_;  ///< r_b cos(beta_b) of the mate [mm]
};

/// The point in the mate's fixed frame [mm], with its velocity per radian of phi1.
Point3<Dual<1>> Passage::PointPath::in_mate(double phi1) const {
  const Passage& p = passage;
  const Dual<1> rotation = p.rotation(p.on_pinion_, phi1, tooth);
  const Point3<double> q = flank_point(p.self_, rho, z, tooth, rotation.value);
  Eigen::Vector3d position(q.x, q.y, q.z), velocity = rotation.gradient[0] * Eigen::Vector3d(-q.y, q.x, 0.0);
  if (p.on_pinion_) {
    position = p.assembly_.wheel_axes.transpose() * (position - p.assembly_.wheel_centre);
    velocity = p.assembly_.wheel_axes.transpose() * velocity;
  } else {
    position = p.assembly_.wheel_axes * position + p.assembly_.wheel_centre;
    velocity = p.assembly_.wheel_axes * velocity;
  }
  const auto component = [&](int i) { return Dual<1>(position[i], Dual<1>::Gradient(velocity[i])); };
  return {component(0), component(1), component(2)};
}

Dual<1> Passage::PointPath::separation(double phi1) const {
  const Passage& p = passage;
  const Dual<1> through = rotation_through(p.mate_, in_mate(phi1), tooth).rotation;
  return (through - p.rotation(!p.on_pinion_, phi1, tooth)) * p.normal_per_angle_;
}

/// Angles of the pitch analysed at which the point lies between form and tip circle of the mate; of the two ranges on
/// either side of the line of centres, where it dips below the form circle there, the one with the undisturbed contact.
std::optional<std::pair<double, double>> Passage::PointPath::facing(double undisturbed) const {
  const Passage& p = passage;
  const auto radius = [&](double phi1) {
    const Point3<Dual<1>> q = in_mate(phi1);
    return std::hypot(q.x.value, q.y.value);
  };
  // The end of the allowed part of [inside, outside], where `excess` <= 0 is allowed and holds at `inside`.
  const auto last_allowed = [](const auto& excess, double inside, double outside) {
    const double at_inside = excess(inside), at_outside = excess(outside);
    if (at_outside <= 0.0) return outside;
    const Root root = bracketed_root(excess, inside, at_inside, outside, at_outside, angle_tolerance);
    return inside < outside ? root.lower : root.upper;
  };
  double lo = p.envelope_.start(), hi = p.envelope_.end();

  // The distance to the mate's axis falls until the point passes the line of centres and rises from there on.
  const Point3<double> start = flank_point(p.self_, rho, z, tooth, 0.0);
  const double to_centres = -std::atan2(start.y, start.x) * p.self_.frame.pinion_turn;  // of tooth 0, as phi1
  const double at_centres = std::clamp(to_centres - tooth * 2.0 * units::pi / p.assembly_.pinion_teeth, lo, hi);
  const auto above_tip = [&](double phi1) { return radius(phi1) - p.mate_.tip_radius; };
  const auto below_form = [&](double phi1) { return p.mate_.form_radius - radius(phi1); };
  if (above_tip(at_centres) > 0.0) return std::nullopt;
  lo = last_allowed(above_tip, at_centres, lo);
  hi = last_allowed(above_tip, at_centres, hi);
  if (below_form(at_centres) > 0.0) {
    const double outer = undisturbed > at_centres ? hi : lo;
    if (below_form(outer) > 0.0) return std::nullopt;
    const double inner = last_allowed(below_form, outer, at_centres);
    lo = std::min(inner, outer);
    hi = std::max(inner, outer);
  }
  return std::pair(lo, hi);
}

double Passage::PointPath::smallest_separation(double undisturbed) const {
  const std::optional<std::pair<double, double>> range = facing(undisturbed);
  if (!range) return infinity;
  // One minimum: the flanks part on either side of it by their relative curvature, far above the curvature of the
  // mesh's error.
  const auto slope = [&](double phi1) { return separation(phi1).gradient[0]; };
  const auto [lo, hi] = *range;
  const double slope_lo = slope(lo), slope_hi = slope(hi);
  double closest = slope_lo >= 0.0 ? lo : hi;
  if (slope_lo < 0.0 && slope_hi > 0.0) closest = bracketed_root(slope, lo, slope_lo, hi, slope_hi, angle_tolerance).x;
  return std::max(0.0, separation(closest).value);
}

std::vector<double> equally_spaced(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(i + 1 == count ? to : from + (to - from) * i / (count - 1));
  return values;
}

}  // namespace

double BearingPattern::covered(double thickness) const {
  // Arc length of an involute per radius is r/r_b: the common factor cancels.
  double all = 0.0, marked = 0.0;
  for (Eigen::Index i = 0; i + 1 < separation.rows(); ++i) {
    const double height = radius[i + 1] * radius[i + 1] - radius[i] * radius[i];
    for (Eigen::Index j = 0; j + 1 < separation.cols(); ++j) {
      const double area = height * (z[j + 1] - z[j]);
      all += area;
      marked += area * static_cast<double>((separation.block<2, 2>(i, j).array() <= thickness).count()) / 4.0;
    }
  }
  return marked / all;
}

BearingPattern bearing_pattern(const FlankAssembly& assembly, const UnloadedMesh& mesh, Member member, int rows, int columns) {
  if (rows < 2) throw InvalidInput("rows", std::to_string(rows), "an integer of at least 2");
  if (columns < 2) throw InvalidInput("columns", std::to_string(columns), "an integer of at least 2");
  const Flank& flank = assembly[member];
  BearingPattern pattern;
  pattern.radius = equally_spaced(flank.form_radius, flank.tip_radius, rows);
  pattern.z = equally_spaced(flank.face.begin, flank.face.end, columns);
  pattern.separation.setConstant(rows, columns, infinity);
  if (mesh.missing > 0) return pattern;
  const Passage passage(assembly, mesh, member);
  for (int i = 0; i < rows; ++i) {
    const double rho = flank.roll_at(pattern.radius[i]);
    for (int j = 0; j < columns; ++j) pattern.separation(i, j) = passage.smallest_separation(rho, pattern.z[j]);
  }
  return pattern;
}

}  // namespace flankwright
