#pragma once

#include <map>
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
  /// By load case, where its loads from outside and torques of other meshes are not those of the reference scaled with the torque: the misalignment of
  /// the mesh with its own, less that with the scaled ones [mm], + opens at +z. Without those below 0.01 um.
  std::map<const LoadCase*, double> misalignment;
};

/// Reads the unit around a stage where its gears have other meshes, or its shafts carry other gears or run in each other; nothing, and nothing said,
/// where they do not, or no shaft of the unit has sections. Shafts that neither meshes nor bearings join to the stage do not belong to its unit. A unit
/// that a study cannot describe is left out with a warning that says why.
/// @param torques  on the pinion; forces from outside and torques of other meshes are those of the reference among them, see reference_of()
/// @throws StudyErrors where shafts that support each other can move as rigid bodies, or an attribute is no number or of a wrong unit
std::optional<ImportedUnit> read_unit(Reading& reading, const StageParts& parts, const GearPair& pair, const std::vector<ImportedTorque>& torques);

}  // namespace flankwright::studies::rexs
