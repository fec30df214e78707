#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/exchange/rexs/rexs_stage.hpp"

namespace flankwright::studies::rexs {

/// Torque on the pinion in one condition of the file.
struct ImportedTorque {
  std::string name{};      ///< "load case 3"; empty: the file's only condition
  double torque{0.0};      ///< [N mm], >= 0
  std::string source{};    ///< what it came from
  double time_share{0.0};  ///< operating_time_fraction, 0 .. 1; 0 where the file does not say
};

/// Torques on the pinion: of the stage's gear data, or from the external loads on the shafts, through the other stages of the gear
/// unit as far as shafts carry one gear and one load or two gears, and gears have one mate (friction and bearings left out; a power needs
/// the shaft's speed). One entry a load case; without load cases one; empty where the file has no torque.
std::vector<ImportedTorque> read_torques(Reading& reading, const StageParts& parts);

}  // namespace flankwright::studies::rexs
