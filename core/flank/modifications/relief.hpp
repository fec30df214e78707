#pragma once

#include <limits>

#include "core/base/jet.hpp"

namespace flankwright {

/// Shape of a relief between its start and its end.
enum class ReliefShape { Linear, Parabolic };

/// Relief measured radially from the tip downwards (tip) or from the start of active profile upwards (root).
struct ProfileRelief {
  double amount{0.0};  ///< material removed at the tip / at the start of active profile [mm]
  double height{0.0};  ///< radial extent [mm], > 0 where amount != 0
  ReliefShape shape{ReliefShape::Linear};
  bool operator==(const ProfileRelief&) const = default;
};

/// Relief from each face end inwards, linear.
struct EndRelief {
  double amount{0.0};  ///< material removed at the face ends [mm]
  double length{0.0};  ///< axial extent from each end [mm], > 0 where amount != 0
  bool operator==(const EndRelief&) const = default;
};

/// C t or C t^2 with t = (distance beyond the start)/extent where that is positive. Its slope jumps at the start of a linear relief.
class ReliefRamp {
 public:
  ReliefRamp(double amount, double extent, ReliefShape shape) {
    if (amount == 0.0) return;  // its extent may be missing
    (shape == ReliefShape::Linear ? linear_ : quadratic_) = shape == ReliefShape::Linear ? amount / extent : amount / (extent * extent);
  }

  /// Adds value and derivatives along one direction.
  /// @param beyond  distance beyond the start [mm]
  /// @param sense   derivative of that distance by the coordinate: 1 or -1
  void add(double beyond, double sense, double& value, double& first, double& second) const {
    if (!(beyond > 0.0) || (linear_ == 0.0 && quadratic_ == 0.0)) return;
    value += (linear_ + quadratic_ * beyond) * beyond;
    first += sense * (linear_ + 2.0 * quadratic_ * beyond);
    second += 2.0 * quadratic_;
  }

 private:
  double linear_{0.0}, quadratic_{0.0};  ///< [mm/mm], [mm/mm^2]
};

/// Distance beyond the start of a relief whose slope jumps there [mm]; minus infinity where it does not: nothing is removed, or the relief is parabolic.
inline double beyond_start(double amount, ReliefShape shape, double beyond) {
  return amount != 0.0 && shape == ReliefShape::Linear ? beyond : -std::numeric_limits<double>::infinity();
}

/// Derivative of a relief by its extent h, one-sided at its start: t = 1 - d/h with d the distance from the end of the relief, so dt/dh = (1 - t)/h.
inline double slope_by_extent(double amount, double extent, ReliefShape shape, double beyond) {
  if (amount == 0.0 || beyond <= 0.0) return 0.0;
  const double t = beyond / extent, slope = amount * (1.0 - t) / extent;
  return shape == ReliefShape::Linear ? slope : 2.0 * t * slope;
}

}  // namespace flankwright
