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
  /// The same teeth stay in mesh: each load cycle is one of both gears' teeth, and `revolutions` is their number.
  bool same_teeth{false};
};

/// Load cycles of each tooth of a gear in so many revolutions of the pinion; of teeth that stay in mesh, as many as of the pinion's.
inline double load_cycles(const GearPair& pair, Member member, double pinion_revolutions, bool same_teeth) {
  return member == Member::Pinion || same_teeth ? pinion_revolutions : pinion_revolutions / pair.gear_ratio();
}

}  // namespace flankwright
