#pragma once

#include "core/gear/gear_data.hpp"
#include "tests/core/gear/pair_cases.hpp"

/// The 30:100 helical pair of NASA TM-107451 and what the report states about it.
///
/// Source: F. L. Litvin, J. Lu, D. P. Townsend, M. Hawkins, "Computerized Simulation of Meshing of Conventional Helical
/// Involute Gears and Modification of Geometry", NASA TM-107451 / ARL-TR-1370, 1997. Section 2: N1 = 30, N2 = 100,
/// alpha_n = 20 deg, P_n = 5 1/in, lambda_p = 60 deg, L = 1.6 in; a left-hand pinion (appendix 1).
///
/// Statements used as tests:
/// - aligned gears touch along a line and transmit without error (eq. 14);
/// - crossing of the axes by 3' and a lead-angle error of 3' cause edge contact and the same almost linear,
/// discontinuous
///   transmission error (figs 2 and 3);
/// - a pressure-angle error of 3' causes none (fig. 4);
/// - crossing by 3' with a lead-angle error of -3' causes none (fig. 9).
namespace flankwright::reference::nasa_tm_107451 {

inline PairData pair_data() {
  PairData data = pair_cases::pair_data(30, 100, 30, units::inch / 5.0, 1.6 * units::inch);
  data.pinion_hand = Hand::Left;
  return data;
}

inline constexpr double lead_angle = 60 * units::deg;  // lambda_p on the pitch cylinders
inline constexpr double error = 3 * units::arcmin;     // of every example

}  // namespace flankwright::reference::nasa_tm_107451
