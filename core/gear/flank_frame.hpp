#pragma once

#include "core/gear/gear_data.hpp"

namespace flankwright {

/// The reference lengths of a removal; see GearPair::flank_frame() for a gear of a pair.
struct FlankFrame {
  double pitch_radius{not_given};        ///< working pitch radius r_w [mm]: origin of crowning and profile slope
  double reference_radius{not_given};    ///< reference radius r [mm]: origin of error profile slope
  double tip_radius{not_given};          ///< of the tip form circle r_Fa, where the flank ends [mm]
  double active_root_radius{not_given};  ///< radius at the start of active profile [mm]
  double face_width{not_given};          ///< b [mm]
  double base_radius{not_given};         ///< r_b [mm]
  double pitch_roll{not_given};          ///< roll length at the working pitch circle [mm]
  double helix_rate{not_given};          ///< turn of the transverse section per mm of z, signed as in Flank [rad/mm]
  double pinion_turn{not_given};         ///< turn of the pinion per turn of this gear in its own frame: 1, or -N2/N1 for the wheel
  double wheel_base_radius{not_given};   ///< r_b2 [mm]
};

}  // namespace flankwright
