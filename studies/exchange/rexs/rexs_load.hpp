#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/gear/gear_data.hpp"
#include "studies/exchange/rexs/rexs_condition.hpp"
#include "studies/exchange/rexs/rexs_stage.hpp"

namespace flankwright::studies::rexs {

/// What says which flank works.
enum class FlankOrigin {
  Stated,   ///< loaded_tooth_flank
  Loads,    ///< the signs of external loads
  Assumed,  ///< nothing
};

/// Signs of the torque of a stage, as the file states them: +1, -1, or 0 where not known.
struct TorqueSigns {
  PerGear<int> data{};  ///< of the torque in the stage's data of each gear
  int loads{0};         ///< of the torque that external loads put on the pinion, about z

  /// Whether the torque has the other sign in one of them.
  bool are_opposite_to(const TorqueSigns& other) const;
};

/// Torque on the pinion of a stage in one condition of the file.
struct ImportedTorque {
  std::string name{};                  ///< "load case 3"; empty: the file's only condition
  const LoadCase* load_case{nullptr};  ///< null: the model alone
  double torque{0.0};                  ///< its size [N mm], >= 0; 0: none, or not in the file
  std::string source{};                ///< what it came from
  WorkingFlank flank{};                ///< of the pinion, that it loads, see StageParts
  FlankOrigin flank_origin{FlankOrigin::Assumed};
  std::string flank_source{};  ///< in words
  TorqueSigns signs{};
};

/// Torques on the pinion, one for each condition: of the stage's gear data, or else of the external loads through shafts and meshes, see TorqueFlow.
///
/// The reference is the first condition with a torque, else the first. Its flank is the loaded_tooth_flank of the load case or the model, else follows
/// from the external loads (right: their torque on the pinion is positive about z), else is the right one. Another condition has the loaded_tooth_flank
/// of its own load case, else the flank of the reference, or the opposite where the torque in the stage's data or that of the external loads has the
/// other sign.
std::vector<ImportedTorque> read_torques(Reading& reading, const StageParts& parts);

/// Torque on the pinion in one condition, as if that were the reference.
ImportedTorque read_torque(const Condition& condition, const StageParts& parts);

/// The first with a torque, else the first. @pre at least one
const ImportedTorque& reference_of(const std::vector<ImportedTorque>& torques);

}  // namespace flankwright::studies::rexs
