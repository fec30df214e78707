#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/units.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright::contact_truth {

/// A point of a transverse section [mm, rad].
struct Polar {
  double radius, angle;
};
inline Polar blend(const Polar& a, const Polar& b, double t) { return {a.radius + t * (b.radius - a.radius), a.angle + t * (b.angle - a.angle)}; }

/// The fillet and half the root land by arc length, 0 .. 1; angles from the tooth's centre line.
class RootCurve {
 public:
  RootCurve(const ToothForm& form, double gap) {
    constexpr int samples = 200;
    for (int i = 0; i <= samples; ++i) {
      const ProfilePoint p = form.fillet_point(form.fillet_start() + (units::pi / 2 - form.fillet_start()) * i / samples);
      add({std::hypot(p.x, p.y), std::atan2(p.x, p.y)});
    }
    fillet_ = length_.back();
    const double start = points_.back().angle;
    for (int i = 1; i <= 20; ++i) add({form.root_radius(), start + (gap - start) * i / 20});
  }
  Polar at(double t) const {
    const double s = t * length_.back();
    const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, s) - length_.begin();
    const auto i = static_cast<std::size_t>(above);
    return blend(points_[i - 1], points_[i], (s - length_[i - 1]) / (length_[i] - length_[i - 1]));
  }

  /// Where the fillet ends, of the whole 0 .. 1.
  double fillet_share() const { return fillet_ / length_.back(); }
  /// Where the fillet, whose radius falls all along, has a radius, of the fillet alone 0 .. 1.
  double along_fillet(double radius) const {
    std::size_t i = 1;
    while (i + 1 < points_.size() && length_[i] < fillet_ && points_[i].radius > radius) ++i;
    const double t = (points_[i - 1].radius - radius) / (points_[i - 1].radius - points_[i].radius);
    return (length_[i - 1] + std::clamp(t, 0.0, 1.0) * (length_[i] - length_[i - 1])) / fillet_;
  }

 private:
  void add(const Polar& p) {
    const double step = points_.empty() ? 0 : std::hypot(p.radius - points_.back().radius, p.radius * (p.angle - points_.back().angle));
    length_.push_back(length_.empty() ? 0 : length_.back() + step);
    points_.push_back(p);
  }
  std::vector<Polar> points_;
  std::vector<double> length_;
  double fillet_{0};  ///< [mm]
};

}  // namespace flankwright::contact_truth
