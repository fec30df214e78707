#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "core/base/natural_spline.hpp"
#include "core/base/root.hpp"
#include "core/base/units.hpp"
#include "core/flank/flank.hpp"
#include "core/gear/involute.hpp"

/// Grinding by brute force: the flank is what no position of the fed tool has removed. Nothing here knows of a contact line, a shift or a twist.
namespace flankwright {

/// Where a function that rises to one summit between two ends is largest, and how large: golden section.
inline std::pair<double, double> summit(const std::function<double(double)>& f, double low, double high, int steps = 48) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double left = high - ratio * (high - low), right = low + ratio * (high - low), f_left = f(left), f_right = f(right);
  for (int i = 0; i < steps; ++i) {
    if (f_left > f_right) {
      high = right;
      right = left, f_right = f_left;
      left = high - ratio * (high - low), f_left = f(left);
    } else {
      low = left;
      left = right, f_left = f_right;
      right = low + ratio * (high - low), f_right = f(right);
    }
  }
  return f_left > f_right ? std::pair(left, f_left) : std::pair(right, f_right);
}

/// The largest removal over the feed positions within a reach of z, at a coarse step first.
inline double largest_removal(const std::function<double(double)>& removed, double z, double reach, double step) {
  double best = z, most = -INFINITY;
  for (double feed = z - reach; feed <= z + reach; feed += step) {
    if (const double here = removed(feed); here > most) best = feed, most = here;
  }
  return summit(removed, best - step, best + step).second;
}

/// The gear alone: its unmodified flank passes through the reference circle on the x axis, as that of Flank does through the pitch circle.
class GroundGear {
 public:
  GroundGear(const GearPair& pair, Member member)
      : gear_(pair[member]), flank_(make_flank(pair, member, {}, {})), alpha_t_(pair.transverse_pressure_angle) {
    flank_.origin = involute(alpha_t_);
  }
  /// Point of the flank [mm], the gear turned.
  Eigen::Vector3d point(double rho, double z, double rotation) const {
    const auto p = flank_point(flank_, rho, z, 0, rotation);
    return {p.x, p.y, p.z};
  }
  /// Base tangent there: what removal moves a point against.
  Eigen::Vector3d tangent(double rho, double z, double rotation) const {
    const double theta = flank_.origin + rotation + flank_.helix_rate * z - rho / flank_.base_radius;
    return {-std::sin(theta), std::cos(theta), 0.0};
  }
  const Gear& gear() const { return gear_; }
  double base_radius() const { return flank_.base_radius; }
  double helix_rate() const { return flank_.helix_rate; }
  double alpha_t() const { return alpha_t_; }
  double helix_angle() const { return std::atan(helix_rate() * gear_.reference_radius); }  ///< signed
  double cos_base_helix() const { return 1.0 / std::hypot(1.0, helix_rate() * base_radius()); }

 private:
  Gear gear_;
  Flank flank_;
  double alpha_t_;
};

/// A threaded wheel: an involute worm of one thread that meets the gear as a pair of crossed axes, turned with it by their normal base pitches, fed along
/// the gear's axis while the gear turns on by its helix, and by f(feed)/r_b more.
class ThreadedWheel {
 public:
  ThreadedWheel(const GroundGear& gear, const PairData& data, double worm_radius)
      : gear_(gear), worm_radius_(worm_radius), helix_(std::acos(data.normal_module / (2.0 * worm_radius))) {
    const double alpha = std::atan(std::tan(data.pressure_angle) / std::cos(helix_));
    worm_base_ = worm_radius * std::cos(alpha);
    worm_origin_ = involute(alpha);
    const double shaft = -(gear.helix_angle() + helix_);
    axis_ = {0.0, -std::sin(shaft), std::cos(shaft)};
    across_ = {0.0, -std::cos(shaft), -std::sin(shaft)};
    worm_rate_ = std::tan(helix_) / worm_radius;
    cos_worm_base_helix_ = 1.0 / std::hypot(1.0, worm_rate_ * worm_base_);
  }

  /// Removed at a point of the flank, along the base tangent [mm].
  double removal(const std::function<double(double)>& f, double rho, double z) const {
    return largest_removal([&](double feed) { return while_at(f, rho, z, feed); }, z, 40.0, 1.0);
  }

 private:
  /// The most that the wheel reaches beyond the point as gear and wheel roll at one feed position.
  double while_at(const std::function<double(double)>& f, double rho, double z, double feed) const {
    const double pass = rho / gear_.base_radius() - std::tan(gear_.alpha_t()) - gear_.helix_rate() * (z - feed);  // through the plane of action
    return summit([&](double roll) { return reach(rho, z, feed, roll, f(feed)); }, pass - 0.1, pass + 0.1).second;
  }
  double reach(double rho, double z, double feed, double roll, double infeed) const {
    const double turn = roll - gear_.helix_rate() * feed + infeed / gear_.base_radius();
    const Eigen::Vector3d p = gear_.point(rho, z, turn) - Eigen::Vector3d(gear_.gear().reference_radius + worm_radius_, 0.0, feed);
    const double x = -p.x(), y = p.dot(across_), along = p.dot(axis_);
    const double on_worm = std::sqrt(x * x + y * y - worm_base_ * worm_base_) / worm_base_;
    // The turn that puts the worm's flank through the point, against the one that it has.
    const double needed = std::atan2(y, x) - std::atan(on_worm) + on_worm - worm_origin_ - worm_rate_ * along;
    const double turned = -roll * gear_.base_radius() * gear_.cos_base_helix() / (worm_base_ * cos_worm_base_helix_);
    return (turned - needed) * worm_base_ * cos_worm_base_helix_ / gear_.cos_base_helix();
  }

  const GroundGear& gear_;
  double worm_radius_, helix_, worm_base_, worm_origin_, worm_rate_, cos_worm_base_helix_;
  Eigen::Vector3d axis_, across_;
};

/// A form wheel: the largest body of revolution that stays out of the unmodified flank, swivelled by the helix angle, fed along the helix while the gear
/// turns by f(feed)/r_b more.
class FormWheel {
 public:
  FormWheel(const GroundGear& gear, double diameter) : gear_(gear), profile_({0.0}, {0.0}) {
    const Gear& g = gear.gear();
    const double half_space = units::pi / g.data.teeth - 0.5 * g.tooth_thickness / g.reference_radius;
    middle_ = half_space;
    centre_ = (0.5 * diameter + g.root_radius) * Eigen::Vector3d::UnitX();
    axis_ = {0.0, std::cos(gear.helix_angle()), -std::sin(gear.helix_angle())};
    // The wheel's radius in its own planes, at axial positions that reach a little beyond the flank.
    const double start = g.roll_length_at(g.form_radius), tip = g.roll_length_at(g.tip_radius);
    lowest_ = 0.4 * start;
    highest_ = tip + 0.5 * (tip - start);
    constexpr int planes = 500;
    std::vector<double> at, radius;
    for (int i = 0; i <= planes; ++i) {
      const double along = std::lerp(place(tip, 0.0, 0.0).x() - 4.0, place(start, 0.0, 0.0).x() + 4.0, static_cast<double>(i) / planes);
      if (const double nearest = nearest_in_plane(along); std::isfinite(nearest)) at.push_back(along), radius.push_back(nearest);
    }
    profile_ = NaturalSpline(at, radius);
  }

  double removal(const std::function<double(double)>& f, double rho, double z) const {
    return largest_removal([&](double feed) { return while_at(f, rho, z, feed); }, z, 40.0, 1.0);
  }

 private:
  /// A point beside the wheel: along its axis, and away from that.
  Eigen::Vector2d beside(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d from = p - centre_;
    const double along = from.dot(axis_);
    return {along, (from - along * axis_).norm()};
  }
  Eigen::Vector2d place(double rho, double z, double turn) const { return beside(gear_.point(rho, z, turn - middle_)); }

  /// Distance of the flank from the axis in one plane of the wheel; infinite where the plane misses the flank.
  double nearest_in_plane(double along) const {
    const auto distance = [&](double z) {
      const auto before = [&](double rho) { return place(rho, z, 0.0).x() - along; };
      const double low = before(lowest_), high = before(highest_);
      if ((low > 0.0) == (high > 0.0)) return -std::numeric_limits<double>::infinity();
      return -place(bracketed_root(before, lowest_, low, highest_, high, 1e-13).x, z, 0.0).y();
    };
    double best = 0.0, most = -INFINITY;
    for (double z = -40.0; z <= 40.0; z += 0.5) {
      if (const double here = distance(z); here > most) best = z, most = here;
    }
    return -summit(distance, best - 0.5, best + 0.5).second;
  }

  /// How far the point must be moved along the base tangent to lie on the wheel.
  double while_at(const std::function<double(double)>& f, double rho, double z, double feed) const {
    const double turn = -gear_.helix_rate() * feed + f(feed) / gear_.base_radius();
    const Eigen::Vector3d p = gear_.point(rho, z, turn - middle_) - feed * Eigen::Vector3d::UnitZ(), t = gear_.tangent(rho, z, turn - middle_);
    const auto outside = [&](double removed) {
      const Eigen::Vector2d q = beside(p - removed * t);
      return q.y() - profile_(q.x());
    };
    constexpr double step = 1e-3, beside_it = 0.05;
    const double here = outside(0.0);
    if (here > beside_it) return -here;  // nowhere near the wheel
    const double slope = (outside(step) - here) / step;
    const double first = -here / slope, rest = outside(first);
    return first - rest / slope;
  }

  const GroundGear& gear_;
  double middle_;            ///< half the angle of the space [rad]
  double lowest_, highest_;  ///< roll lengths of the helicoid that is wrapped [mm]
  Eigen::Vector3d centre_, axis_;
  NaturalSpline profile_;  ///< radius over the position along the axis
};

}  // namespace flankwright
