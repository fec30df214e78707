#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

/// Unit factors, used at the input and output boundary only: value_inside = value_outside * factor.
/// Inside everything is mm, N, rad, MPa.
namespace flankwright::units {

inline constexpr double pi = std::numbers::pi;
inline constexpr double deg = pi / 180.0;
inline constexpr double arcmin = deg / 60.0;
inline constexpr double arcsec = deg / 3600.0;
inline constexpr double arcsec_per_square_deg = arcsec / (deg * deg);  // 1/rad
inline constexpr double um = 1e-3;
inline constexpr double inch = 25.4;
inline constexpr double newton_metre = 1e3;  // N mm

/// A value outside without the round-off of its conversion: 6 um, where 0.006 mm times 1000 is 5.999999999999999. It is the nearest multiple of 1e-9, far finer than what
/// anyone gives or grinds, where that is within a few units of round-off.
inline double without_round_off(double outside) {
  constexpr double parts = 1e9;
  const double even = std::round(outside * parts) / parts;
  return std::abs(outside - even) <= 8.0 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(outside)) ? even : outside;
}

}  // namespace flankwright::units
