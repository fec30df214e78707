#pragma once

#include <cmath>

#include "core/flank/removal.hpp"

namespace flankwright {

/// Frame of a flank of usual proportions, for tests of modifications [mm].
inline FlankFrame sample_flank_frame() {
  return {.pitch_radius = 50.0,
          .reference_radius = 49.5,
          .tip_radius = 54.0,
          .active_root_radius = 47.0,
          .face_width = 30.0,
          .base_radius = 46.5,
          .pitch_roll = std::sqrt(50.0 * 50.0 - 46.5 * 46.5),
          .helix_rate = 0.01,
          .pinion_turn = 1.0,
          .wheel_base_radius = 90.0};
}

}  // namespace flankwright
