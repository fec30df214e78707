#pragma once

#include <map>
#include <string>

#include "core/gear/gear_data.hpp"
#include "studies/exchange/rexs/rexs_stage.hpp"

namespace flankwright::studies::rexs {

/// Where a value came from, or why it is none of the file's, by key of the study.
using Remarks = std::map<std::string, std::string>;

/// What both gears of a stage have in common.
struct ImportedMesh {
  double normal_module{not_given};         ///< m_n [mm]
  double pressure_angle{20 * units::deg};  ///< alpha_n [rad]
  double helix_angle{0.0};                 ///< |beta| at the reference cylinder [rad], >= 0
  Hand pinion_hand{Hand::Right};           ///< the wheel's is the opposite
  double centre_distance{not_given};       ///< a_w [mm]; not given: the file does not say
  Remarks remarks{};                       ///< by the names of these members
};

/// Reads it from either gear, one of which may say nothing. Without an angle in the file the teeth are spur, the pressure angle is 20 deg, and the
/// remarks say so.
/// @throws StudyErrors with component, attribute and value where the module is missing or the gears contradict each other
ImportedMesh read_mesh(Reading& reading, const StageParts& parts);

}  // namespace flankwright::studies::rexs
