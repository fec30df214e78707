#pragma once

#include <cmath>
#include <numbers>

#include "core/compliance/local/free_end.hpp"

namespace flankwright {

/// What one body's contact yields less near the end of a load that stops at an overhang o before the body's own end face, because its mate is
/// narrower: the flank beyond holds up the load's end. In the bracket of FreeEnd, and negative there,
///
///     -(I(t + 2 o) - I(t))/2,
///     I(x) = (1 - nu^2) [asinh(x/e) - asinh(x/H)] - (1 + nu)/2 (h/H)^2 x/sqrt(x^2 + H^2),   e = L/(2 sqrt(exp 1)),   H^2 = h^2 + e^2,
///
/// t being the distance from the load's end. Seen from the end face, which is a mirror but for the stress along the axis, the line of force is
/// missing over the length 2 o between the load and its image. I(x) is what a line of force of length x on a half-space, from right below on, adds to the approach
/// towards the depth h [Boussinesq; Johnson, Contact Mechanics, 1985, eqs 3.19 and 3.22]; e is the distance from a line that sinks as much as the middle of Hertz's
/// pressure, so that I for x to infinity is half of plane strain's own bracket where h is much larger than L: a load that ends in an endless body sinks
/// half as much there.
///
/// The stress along the axis that the end face is free of is less as well: FreeEnd's kappa ln(1 + a h/s) is what a kernel
/// kappa (1/(s + z) - 1/(s + z + a h)) gives for a load from z = 0 on, s and z alike as Maxwell asks; a load from z = o on has s + o for s.
///
/// Nothing is fitted. The block of free_end_test.cpp with its load begun at o = 0.3 to 2.1 L has the same to within 0.1 where it differs from plane strain by up
/// to 1.1. Leaning faces are not checked.
/// @param from_load_end  t >= 0
/// @param overhang       o >= 0
/// @param depth          h > 0
/// @param half_width     L > 0, all in one unit of length
inline FreeEnd::Softening load_end_support(double poissons_ratio, double from_load_end, double overhang, double depth, double half_width) {
  const double nu = poissons_ratio, plane_strain = 1 - nu * nu, spread = half_width / (2 * std::sqrt(std::numbers::e));
  const double square = spread * spread, deep = depth * depth + square, by_depth = 0.5 * (1 + nu) * depth * depth / deep;
  const auto integral = [&](double x) -> FreeEnd::Softening {
    const double near = std::hypot(x, spread), far = std::sqrt(x * x + deep), turned = x / far;
    // e grows as L, and H dH = e de.
    return {plane_strain * (std::asinh(x / spread) - std::asinh(x / std::sqrt(deep))) - by_depth * turned,
            -plane_strain * (x / near - turned * square / deep) + by_depth * turned * square * (2 / deep + 1 / (far * far))};
  };
  const FreeEnd::Softening end = integral(from_load_end + 2 * overhang), start = integral(from_load_end);
  return {-0.5 * (end.value - start.value), -0.5 * (end.widening - start.widening)};
}

}  // namespace flankwright
