#pragma once

#include <cmath>

#include "core/gear/gear_data.hpp"

/// The 20:40 spur pair of NASA TM-100260 and what the report states about it.
///
/// Source: F. L. Litvin, J. Zhang, R. F. Handschuh, "Generation of a Crowned Pinion Tooth Surface by a Surface of
/// Revolution", NASA TM-100260 / AVSCOM TR-87-C-34, 1988. Numerical example: N1 = 20, N2 = 40, P_n = 10 1/in, psi_c =
/// 20 deg, alpha = 80 deg, d = 0.176 in, rho = 500 in, centre distance + 1 %. Face width and tooth height are not
/// stated.
///
/// Statements used as tests:
/// - the transmission error is a parabola, aligned (type 2 of fig. 3(b)) and misaligned, without discontinuity
/// (conclusions 1 and 2);
/// - its maxima are 0.30 and 0.31 arcsec with axes crossed by 5 and 10 arcmin, 0.34 and 0.32 arcsec with axes
/// intersecting by as much.
namespace flankwright::reference::nasa_tm_100260 {

inline constexpr double pressure_angle = 20 * units::deg;  // psi_c
inline constexpr RevolutionTool tool{80 * units::deg, 0.176 * units::inch, 500 * units::inch};
inline constexpr double centre_distance_change = 0.01;

/// @param addendum  in modules
inline PairData pair_data(double addendum = 1.0) {
  PairData data;
  data.normal_module = units::inch / 10.0;
  data.pressure_angle = pressure_angle;
  data.pinion.teeth = 20;
  data.wheel.teeth = 40;
  data.pinion.face_width = data.wheel.face_width = 0.5 * units::inch;  // chosen
  data.pinion.rack.addendum = data.wheel.rack.addendum = addendum;
  data.pinion.generation = tool;
  return data;
}

struct Example {
  double crossing, intersecting;  ///< [rad]
  double published;               ///< maximum of the kinematic error [rad]
};
inline constexpr Example examples[]{{5 * units::arcmin, 0.0, 0.30 * units::arcsec},
                                    {10 * units::arcmin, 0.0, 0.31 * units::arcsec},
                                    {0.0, 5 * units::arcmin, 0.34 * units::arcsec},
                                    {0.0, 10 * units::arcmin, 0.32 * units::arcsec}};

/// -m21'/2 of eq. (8), with the factor N1/N2 that it lacks: a [1/rad].
inline double coefficient() {
  const double ratio = 20.0 / 40.0, r1 = 20 * units::inch / 10.0 / 2, curvature = 1 / tool.arc_radius;
  const double slope = ratio * (1 + ratio) * std::tan(pressure_angle) * curvature / ((1 + ratio) / (r1 * std::sin(pressure_angle)) + curvature);
  return slope / 2;
}

}  // namespace flankwright::reference::nasa_tm_100260
