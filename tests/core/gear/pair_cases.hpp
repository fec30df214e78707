#pragma once

#include "core/base/units.hpp"
#include "core/gear/gear_pair.hpp"

/// Gear pairs that tests of every folder begin with.
namespace flankwright::pair_cases {

/// Two gears of the standard rack, equally wide and without profile shift; helix angle in degrees, module and face width in mm.
inline PairData pair_data(int z1, int z2, double helix_angle_deg, double module, double face_width) {
  PairData data;
  data.normal_module = module;
  data.helix_angle = helix_angle_deg * units::deg;
  data.pinion.teeth = z1;
  data.wheel.teeth = z2;
  data.pinion.face_width = data.wheel.face_width = face_width;
  return data;
}

inline GearPair pair(int z1, int z2, double helix_angle_deg, double module, double face_width) {
  return make_gear_pair(pair_data(z1, z2, helix_angle_deg, module, face_width));
}

}  // namespace flankwright::pair_cases
