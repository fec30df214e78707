#pragma once

#include <array>

namespace flankwright {

/// What a free end face adds to the deflection of a line contact near it, of one body:
///
///     (2/pi) (w/E) [kappa ln(1 + a h/S) + lambda/2 ln(1 + (a' h/S')^2)],   S = s + c L^2/(L + 2 s),   S' likewise with c'.
///
/// s is the distance from the end, h the depth that the deflection is referred to, L the half width of Hertz's
/// pressure, w the line load, even along the line and up to the end. Away from an end the load strains its surroundings
/// in the plane across it (plane strain), which takes an axial stress nu (sigma_x + sigma_y). The end face is free of
/// that stress; with it removed there, the body yields as a quarter space. Below a line of force all stress is of
/// degree -1 in the lengths. The deflection down to a depth y >> s therefore grows with ln(y), by 1 - nu^2 + kappa
/// where plane strain has 1 - nu^2; where y << s the contribution of the end decays as y/s. kappa exceeds plane stress'
/// nu^2 (0.21 for 0.09 at nu = 0.3).
///
/// kappa, a and c fit a numerical solution: the block under Hertz's pressure of free_end_test.cpp with 16 x 16 x 19
/// bricks out to 770 half widths, at nu = 0.15, 0.3 and 0.45,
///
///     kappa = nu (0.27 + 1.49 nu),   a = nu (2.15 - 1.6 nu),   c = 0.15 + 0.3 nu,
///
/// to within 0.01, 0.024 and 0.045 in the bracket for h = 2 .. 36 L, s = 0 .. 58 L, where that reaches 0.3, 0.9 and 1.9
/// and plane strain's own 3 to 4.
///
/// The second term belongs to a face that leans by theta from the normal of the line of contact, as those of helical
/// teeth do by the base helix angle. An acute end (theta > 0, 90 deg - theta of material) bends like the edge of a
/// wedge; an obtuse one is supported by the material beyond the face. The term fits blocks with a leaning end, 14 x 13
/// x 13 bricks out to 256 half widths, theta = -32 .. 32 deg in steps of 8, the same three nu, h = 6 .. 36 L: their
/// flank's deflection beyond the structural one, with load and deflection as in the finite elements
/// (centre_functional() on the plane h below the flank), less that of a block that does not lean,
///
///     lambda = (0.452 + 0.347 nu) (exp(3.6 theta) - 1),   a' = 0.2 + 0.95 nu,   c' = 0.19.
///
/// to within 0.03, 0.06, 0.15 and 0.43 (root mean square) at acute ends of 8, 16, 24 and 32 deg, where it reaches 1.9,
/// 4.9, 9.8 and 18, and to 0.03, 0.07, 0.12 and 0.17 at obtuse ones, -1.3, -2.1, -2.7 and -3.1. Larger angles are
/// extrapolated. With the deflection of the point h below the flank, or of the end face where that lies outside,
/// instead of the functional it is 5 to 20 % more; finer bricks add 1 %.
///
/// The body is assumed to extend far beyond h. A tooth does not, and the contribution of an upright end is smaller by
/// 0.05 to 0.1 from s = 0 to h. The sum with the structural deflection matters, and it is as good at the end as at mid
/// face (finite_element/README.md).
/// Beside finite elements of the structure the bracket is counted from its value at mid face, because their structural deflection at mid face already has what
/// the ends soften there (effects/tip_corner.hpp).
///
/// Within about the half width next to the end the pressure itself is wider and lower than Hertz's of the same load, by
/// the root of 1 + kappa/(1 - nu^2) at the very end: 11 % for nu = 0.3, 4 % half a half width away and 2 % a whole one.
/// L does not account for that, so that stress there is over-estimated by as much. Loads that vary along the line: see ContactKernel.
struct FreeEnd {
  double strength{0};               ///< kappa [-], 0 .. 0.51
  double reach{0};                  ///< a [-], 0 .. 0.68
  double bluntness{0};              ///< c [-]
  std::array<double, 2> leaning{};  ///< lambda of either end [-], > 0 at the acute one, 0 where the face is upright
  double leaning_reach{0};          ///< a' [-], 0.2 .. 0.68

  FreeEnd() = default;
  /// @param poissons_ratio  nu, 0 .. 0.5
  /// @param lean            theta of the first end; the second's, parallel to it, is -lean [rad]
  explicit FreeEnd(double poissons_ratio, double lean = 0);

  struct Softening {
    double value;     ///< the bracket, both ends added up [-]; an end infinitely far away adds nothing
    double widening;  ///< L times its derivative by L [-]
  };
  /// @param distances   s of either end, along the line, >= 0, infinity too
  /// @param depth       h > 0
  /// @param half_width  L > 0, all in one unit of length
  Softening at(const std::array<double, 2>& distances, double depth, double half_width) const;
};

}  // namespace flankwright
