#pragma once

#include <array>

#include "core/compliance/local/free_end.hpp"

namespace flankwright {

/// The deflection of one body between its flank and the depth h, at one place of a line of contact, under a force at another place of this line. The law of
/// an even load, see ContactLaw, is the integral of this kernel g over the face, but for a part that stays with the point's own load. In the bracket of FreeEnd, (2/pi)(w/E), per length,
///
///     g(s, t) = G(s - t) + G(s + t) + lambda (1/x - x/(x^2 + (a' h)^2)),   x = s + t + e,
///     G(r) = (1 - nu^2)/2 [1/sqrt(r^2 + e^2) - 1/sqrt(r^2 + H^2)] - (1 + nu)/4 h^2/(r^2 + H^2)^(3/2),   H^2 = h^2 + e^2,
///
/// s and t being distances along the line from an end face; of the second face likewise. G is the approach of the surface of a half-space, e beside the
/// force, towards the point h below it [Boussinesq; Johnson, Contact Mechanics, 1985, eqs 3.19 and 3.22]. The end face is a mirror. Where it leans the edge
/// bends as a whole: the last term is symmetric, as Maxwell asks, and its integral over t > 0 is FreeEnd's lambda/2 ln(1 + (a' h/s)^2). What FreeEnd has
/// for the stress along the axis, kappa ln(1 + a h/s), belongs to the load at s itself: under a load that rises from 0 at the end face the blocks of
/// free_end_test.cpp have nothing of it there. Nothing is fitted.
///
/// e = h/10 takes the place of the half width L: a load that changes within less is not spread. The law of an even load has the slope dc/dw that G's integral
/// has for L = 2 e, and a larger one where L is smaller. While L < h/5 what a load gives to its neighbours is therefore less than the law has, and contact
/// alone is convex; beyond, the structure has to make up for it.
class ContactKernel {
 public:
  /// Places along the line [mm].
  struct Range {
    double begin, end;
  };

  /// @param poissons_ratio  nu, 0 .. 0.5
  /// @param face            the body's own end faces
  /// @param lean            theta of the first face [rad], see FreeEnd
  /// @param free_ends       false: the faces are mirrors only
  ContactKernel(double poissons_ratio, const Range& face, double lean, bool free_ends);

  /// g between two places [-/mm]; symmetric.
  /// @param depth  h > 0 [mm]
  double between(double s, double t, double depth) const;
  /// The mean of g over two parts of a line that do not overlap [-/mm]; symmetric. Parts whose middles are four times the longer one apart, or
  /// more, have the value of their middles, within 1 % of what 1/r has; so has what a leaning end adds.
  double between(const Range& one, const Range& other, double depth) const;
  /// The integral of g over a load from its begin to its end [-].
  double over(double s, const Range& load, double depth) const;

 private:
  double poissons_ratio_;
  Range face_;
  FreeEnd end_;  ///< without lambda where the ends are not free
};

}  // namespace flankwright
