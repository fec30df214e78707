#pragma once

#include <cmath>

#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// How long and how fast a pair runs under one load. NaN: not given.
struct Operation {
  double revolutions{not_given};  ///< of the pinion: load cycles of each of its teeth [-], >= 0
  double speed{not_given};        ///< of the pinion [rad/s], > 0
  double duration{not_given};     ///< [s], >= 0
  double temperature{not_given};  ///< of the oil [deg C]
};

/// Load cycles of each tooth of a gear in so many revolutions of the pinion.
inline double load_cycles(const GearPair& pair, Member member, double pinion_revolutions) {
  return member == Member::Pinion ? pinion_revolutions : pinion_revolutions / pair.gear_ratio();
}

}  // namespace flankwright
