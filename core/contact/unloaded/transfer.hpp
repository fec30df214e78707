#pragma once

#include "core/base/units.hpp"

namespace flankwright {

/// Transfer of contact from one pair to another, located to round-off.
struct Transfer {
  double phi1{not_given};                ///< [rad]
  double transmission_error{not_given};  ///< [rad], wheel
  int from_tooth{0}, to_tooth{0};
  double slope_before{not_given}, slope_after{not_given};  ///< d(delta_phi2)/d(phi1) of the pair that leaves, that enters [rad/rad]

  /// Step of the wheel's speed as a fraction of the pinion's: what excites noise. Positive, as the envelope is a maximum.
  double slope_jump() const { return slope_after - slope_before; }
};

}  // namespace flankwright
