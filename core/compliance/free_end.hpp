#pragma once

#include <array>

namespace flankwright {

/// What a free end face adds to the deflection of a line contact near it, of one body:
///
///     (2/pi) (w/E) kappa f,   f = ln(1 + a h/S),   S = s + c L^2/(L + 2 s).
///
/// s is the distance from the end, h the depth that the deflection is referred to, L the half width of Hertz's pressure, w the line load, even
/// along the line and up to the end. Away from an end the load strains its surroundings in the plane across it (plane strain), which takes an axial
/// stress nu (sigma_x + sigma_y). The end face is free of that: take it off there, and what gives way is a quarter space. Below a line of force
/// all stress is of degree -1 in the lengths. The deflection down to a depth y >> s therefore grows with ln(y), by 1 - nu^2 + kappa where
/// plane strain has 1 - nu^2; where y << s what the end adds dies away as y/s. kappa exceeds plane stress' nu^2 (0.21 for 0.09 at nu = 0.3).
///
/// kappa, a and c stand for a numerical solution: the block under Hertz's pressure of free_end_test.cpp with 16 x 16 x 19 bricks out to
/// 770 half widths, at nu = 0.15, 0.3 and 0.45,
///
///     kappa = nu (0.27 + 1.49 nu),   a = nu (2.15 - 1.6 nu),   c = 0.15 + 0.3 nu,
///
/// which is met to 0.01, 0.024 and 0.045 in kappa f for h = 2 .. 36 L, s = 0 .. 58 L, where kappa f reaches 0.3, 0.9 and 1.9 and plane strain's
/// own bracket 3 to 4.
///
/// Assumed: an end face normal to the line of contact (of helical teeth the distance along the axis is taken, whatever the angle between
/// flank and face), and a body that goes on far beyond h. In a tooth it does not, and kappa f is less by 0.05 to 0.1 from s = 0 to h; what
/// counts is the sum with the structure, which comes out at the end as it does at mid face (finite_element/README.md).
///
/// Within about the half width next to the end the pressure itself is wider and lower than Hertz's of the same load, by the root of
/// 1 + kappa/(1 - nu^2) at the very end: 11 % for nu = 0.3, 4 % half a half width away and 2 % a whole one. L does not know of that: stress
/// there is over-estimated by as much.
struct FreeEnd {
  double strength{0};  ///< kappa [-], 0 .. 0.51
  double reach{0};     ///< a [-], 0 .. 0.68
  double bluntness{0};  ///< c [-]

  FreeEnd() = default;
  /// @param poissons_ratio  nu, 0 .. 0.5
  explicit FreeEnd(double poissons_ratio);

  struct Softening {
    double value;     ///< sum of f over both ends [-], >= 0; an end infinitely far away adds nothing
    double widening;  ///< L times its derivative by L [-], <= 0 and less than 2 f in size, so that w f grows with w
  };
  /// Both ends together, which takes one logarithm.
  /// @param distances   s of either end, >= 0, infinity too
  /// @param depth       h > 0
  /// @param half_width  L > 0, all in one unit of length
  Softening at(const std::array<double, 2>& distances, double depth, double half_width) const;
};

}  // namespace flankwright
