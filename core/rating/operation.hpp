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
  PerGear<int> meshes_per_revolution{1, 1};  ///< how many mates load this flank of each gear, all as much as the pair's [-], >= 1
  double application_factor{1.0};            ///< K_A [ISO 6336-6] [-], >= 1
  double dynamic_factor{1.0};                ///< K_v [ISO 6336-1] [-], >= 1

  /// K_A K_v, by which a rating multiplies the loads of the nominal torque [-].
  double overload() const { return application_factor * dynamic_factor; }
  /// By which it multiplies their contact stress, which is Hertz's [ISO 6336-2, sigma_H; ISO/TS 6336-22, p_dyn of method A] [-].
  double contact_overload() const { return std::sqrt(overload()); }
};

/// Load cycles of each tooth of a gear: its contacts under load [ISO 6336-2:2006, N_L of the life factor]. Teeth that stay in mesh have as many as those of the
/// pinion. Others have one with each mate in a revolution of their gear.
inline double load_cycles(const GearPair& pair, Member member, const Operation& operation) {
  if (operation.same_teeth) return operation.revolutions;
  const double revolutions = member == Member::Pinion ? operation.revolutions : operation.revolutions / pair.gear_ratio();
  return operation.meshes_per_revolution[member] * revolutions;
}

}  // namespace flankwright
