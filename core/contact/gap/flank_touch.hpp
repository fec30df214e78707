#pragma once

#include <array>

#include "core/contact/path/contact_points.hpp"

namespace flankwright {

/// Where two flanks that deviate from their involutes touch in the transverse section of a contact point. Lengths in mm; along the flanks they count
/// from where the involutes touch, towards the wheel's tip.
struct FlankTouch {
  /// A place on both flanks with its weight in derivatives: one, or on a kink of a flank one on either side of it.
  struct Side {
    PerGear<double> radius;  ///< [mm]
    double share{0.0};       ///< of the derivative [-]; both sides' add up to 1
  };

  double gap{0.0};                 ///< clearance and deviations there, normal to the flanks
  double along{0.0};               ///< x: vertex of the parabola of both flanks, beyond an edge where the flanks would go on touching there
  double along_by_slope{0.0};      ///< dx by the slope dh/dx of the deviations; 0 on a kink, which stays where it is
  double on_rounding{0.0};         ///< how far beyond an edge its rounding touches, signed as x; 0: the flanks touch
  double rounded_off{0.0};         ///< part of the sharp edge's clearance that the rounding fills
  double by_lag{0.0};              ///< R L', see FlankTouchSearch
  double by_lag_change{0.0};       ///< R L'', along the profile [-]
  PerGear<double> slid{0.0, 0.0};  ///< place on either flank less x, by a displacement of the wheel
  std::array<Side, 2> sides;
};

/// How far a touch takes the parabola away from the tip edge of its point [mm].
inline double edge_moved_by(const ContactPoint& point, const FlankTouch& touch) {
  const double towards_tip = point.tip_edge.gear == Member::Wheel ? 1.0 : -1.0;
  return -towards_tip * (touch.along + touch.slid[point.tip_edge.gear]);
}

}  // namespace flankwright
