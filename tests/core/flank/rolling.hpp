#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/flank/flank.hpp"
#include "core/gear/involute.hpp"

/// The generating motion, for tests that look at a flank from its tool without using the product's envelope.
namespace flankwright::rolling {

/// Frame of the straight rack in the transverse section, seen from a gear that has rolled by psi: x along the gear's radius from
/// the rolling line to the tip, y out of the tooth, z the gear's. At psi = 0 the straight rack touches the gear's reference point
/// in the origin.
inline Eigen::Vector3d in_rack(const GearPair& pair, Member member, const Point3<double>& p, double psi) {
  const Gear& gear = pair[member];
  const double alpha_t = std::acos(gear.base_radius / gear.reference_radius);
  const double back = involute(pair.working_transverse_pressure_angle) - involute(alpha_t);
  const double c = std::cos(psi - back), s = std::sin(psi - back);
  return {c * p.x - s * p.y - gear.reference_radius, s * p.x + c * p.y - gear.reference_radius * psi, p.z};
}

/// Roll angle at which the flank's transverse normal at p passes through the pitch point: the equation of meshing, geometrically.
inline double roll_of_normal(const GearPair& pair, Member member, const SurfacePoint& at) {
  const Gear& gear = pair[member];
  const double alpha_t = std::acos(gear.base_radius / gear.reference_radius);
  const double back = involute(pair.working_transverse_pressure_angle) - involute(alpha_t);
  const Eigen::Vector2d p = at.position.head<2>(), n = at.normal.head<2>().normalized();
  const double along = p.dot(n), off = p.x() * n.y() - p.y() * n.x();
  const double l = along - std::sqrt(gear.reference_radius * gear.reference_radius - off * off);
  const Eigen::Vector2d pitch_point = p - l * n;
  return back - std::atan2(pitch_point.y(), pitch_point.x());
}

/// How deep the tip of the rack reaches, x in its frame [mm]: where the tool ends.
inline double tool_tip(const GearPair& pair, Member member) {
  const GearData& gear = pair[member].data;
  return (gear.profile_shift - gear.rack.dedendum) * pair.data.normal_module;
}

/// The least value of f over [a, b] found by a fine sweep and golden-section search, to round-off of f.
template <class Function>
double least(const Function& f, double a, double b) {
  constexpr int kSteps = 400;
  int best = 0;
  for (int i = 1; i <= kSteps; ++i) {
    if (f(a + i * (b - a) / kSteps) < f(a + best * (b - a) / kSteps)) best = i;
  }
  double lo = a + std::max(0, best - 1) * (b - a) / kSteps, hi = a + std::min(kSteps, best + 1) * (b - a) / kSteps;
  constexpr double kGolden = 0.6180339887498949;
  for (int i = 0; i < 60; ++i) {
    const double x = hi - kGolden * (hi - lo), y = lo + kGolden * (hi - lo);
    if (f(x) < f(y)) {
      hi = y;
    } else {
      lo = x;
    }
  }
  return f(0.5 * (lo + hi));
}

}  // namespace flankwright::rolling
