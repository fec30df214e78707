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
    const double start = points_.back().angle;
    for (int i = 1; i <= 20; ++i) add({form.root_radius(), start + (gap - start) * i / 20});
  }
  Polar at(double t) const {
    const double s = t * length_.back();
    const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, s) - length_.begin();
    const auto i = static_cast<std::size_t>(above);
    return blend(points_[i - 1], points_[i], (s - length_[i - 1]) / (length_[i] - length_[i - 1]));
  }

 private:
  void add(const Polar& p) {
    const double step = points_.empty() ? 0 : std::hypot(p.radius - points_.back().radius, p.radius * (p.angle - points_.back().angle));
    length_.push_back(length_.empty() ? 0 : length_.back() + step);
    points_.push_back(p);
  }
  std::vector<Polar> points_;
  std::vector<double> length_;
};

}  // namespace flankwright::contact_truth
