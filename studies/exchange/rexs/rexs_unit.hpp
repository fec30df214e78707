#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/compliance/shaft/unit_data.hpp"
#include "studies/exchange/rexs/rexs_load.hpp"
#include "studies/exchange/rexs/rexs_shaft.hpp"

namespace flankwright::studies::rexs {

/// All shafts of a file around one stage, with what joins and loads them.
struct ImportedUnit {
  ShaftsOfPair shafts;
  PerGear<Remarks> remarks;                ///< of the pair's shafts
  std::string reference_remark;            ///< the condition of the reference torque
  std::vector<std::string> shaft_remarks;  ///< of the further ones, the loads' and the joints' remarks, one each
  std::vector<std::string> load_remarks, joint_remarks;
  std::vector<Remarks> mesh_remarks;  ///< one for each mesh, as ImportedMesh::remarks, and of torque_1
};

/// Reads the unit around a stage where its gears have other meshes, or its shafts carry other gears or run in each other; nothing, and nothing said,
/// where they do not, or have no sections. A unit that a study cannot describe is left out with a warning that says why.
/// @param reference  on the pinion, see reference_of(); forces from outside and torques of other meshes are those of its condition
std::optional<ImportedUnit> read_unit(Reading& reading, const StageParts& parts, const GearPair& pair, const ImportedTorque& reference);

}  // namespace flankwright::studies::rexs
