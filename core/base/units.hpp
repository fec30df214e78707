#pragma once

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

}  // namespace flankwright::units
