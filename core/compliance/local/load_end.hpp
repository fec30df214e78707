#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/compliance/local/free_end.hpp"

namespace flankwright {

/// What one body's contact yields less near the ends of a load that stops at an overhang o before the body's own end face, because its mate is
/// narrower: the flank beyond holds up the load's end. In the bracket of FreeEnd, and negative there; of each end
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
/// @param from_load_ends  t of either end, >= 0; of no account where the overhang is 0
/// @param overhangs       o of either end, >= 0; 0: the body's own end face is where the load stops
/// @param depth           h > 0
/// @param half_width      L > 0, all in one unit of length
inline FreeEnd::Softening load_end_support(double poissons_ratio, const std::array<double, 2>& from_load_ends, const std::array<double, 2>& overhangs,
                                           double depth, double half_width) {
  const double nu = poissons_ratio, plane_strain = 1 - nu * nu, spread = half_width / (2 * std::sqrt(std::numbers::e)), square = spread * spread;
  const double deep = depth * depth + square, by_depth = 0.5 * (1 + nu) * depth * depth / deep;
  // The four inverse sines of an end, and those of both ends, are the logarithm of one quotient.
  double above = 1, below = 1, turned = 0, widening = 0;
  const auto add = [&](double x, double sense, double& near_side, double& far_side) {
    const double near = std::sqrt(x * x + square), far = std::sqrt(x * x + deep), turn = x / far;
    near_side *= x + near;
    far_side *= x + far;
    turned += sense * turn;
    // e grows as L, and H dH = e de.
    widening -= sense * (plane_strain * (x / near - turn * square / deep) - by_depth * turn * square * (2 / deep + 1 / (far * far)));
  };
  for (std::size_t i = 0; i < overhangs.size(); ++i) {
    if (overhangs[i] == 0) continue;
    add(from_load_ends[i] + 2 * overhangs[i], 1, above, below);
    add(from_load_ends[i], -1, below, above);
  }
  return {-0.5 * (plane_strain * std::log(above / below) - by_depth * turned), -0.5 * widening};
}

}  // namespace flankwright
