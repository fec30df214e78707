#pragma once

#include <array>
#include <vector>

#include "core/compliance/shaft/beam_system.hpp"
#include "core/compliance/shaft/unit_data.hpp"

namespace flankwright {

/// Torques of a unit per torque on the pinion, from the balance of torques about the axes of all shafts. About z; the pair as it is analysed, with a
/// positive torque on the pinion.
struct UnitTorques {
  std::vector<double> mesh;      ///< on the first gear of each mesh by its shaft [-]
  std::vector<double> coupling;  ///< that enters each shaft at its torque_position [-]; 0 where it has none
  /// The shaft whose torques balance least, and by how much not [-]; empty where all do.
  std::vector<std::pair<int, double>> unbalanced;
  bool determined{true};  ///< false: the balance leaves several possibilities

  bool solved() const { return determined && unbalanced.empty(); }
};

/// Tangential forces f of meshes and torques of couplings balance each shaft: sum of -r_w f, loads and coupling is 0.
/// @param shafts  as the pair is analysed, see mirrored(); loads and gears on shafts that are there
/// What is round-off of this balance is 0: gears and couplings that idle.
UnitTorques torque_balance(const ShaftsOfPair& shafts, const GearPair& pair);

/// The same of shafts as the study has them.
UnitTorques torques_as_analysed(ShaftsOfPair shafts, const GearPair& pair);

/// Forces of one mesh on the shafts of its gears, per torque on the first gear: a normal force at the pitch point at mid face, on the
/// flanks that the torque's sign asks for.
/// @param torque  on the first gear by its shaft [N mm]
std::vector<BeamLoad> mesh_loads(const ShaftsOfPair& shafts, const UnitMesh& mesh, double torque);

/// Direction along which a mesh pushes its second gear, in the transverse plane: the outward normal of the first gear's working flank.
/// @param torque  on the first gear by its shaft; its sign says which flank
Eigen::Vector3d transverse_normal(const UnitMesh& mesh, double torque);

/// A moment on each gear of a mesh that does work on the tilt of the second one against the first in the base tangent plane, + opens the mesh at +z.
std::array<BeamLoad, 2> mesh_tilt(const ShaftsOfPair& shafts, const UnitMesh& mesh, double torque);

/// All that acts on the shafts beside the pair's own mesh in proportion to its torque, per torque on the pinion [N and N mm per N mm].
std::vector<BeamLoad> outside_loads(const ShaftsOfPair& shafts, const UnitTorques& torques);

/// All that acts on them whatever the torque is [N and N mm].
std::vector<BeamLoad> constant_loads(const ShaftsOfPair& shafts);

/// How many meshes load the teeth of one of the pair's gears on the flank that the pair loads in a revolution of it: that of the pair, and the unit's on the same gear
/// whose torque is of the same sign. An idler's second mesh loads the other flank.
/// @param shafts  as the study has them, without problems
int meshes_per_revolution(const ShaftsOfPair& shafts, const GearPair& pair, Member member);
/// How many meshes of the unit load the teeth of this gear on their other flanks in a revolution: the second mesh of an idler.
int meshes_on_other_flank(const ShaftsOfPair& shafts, const GearPair& pair, Member member);

/// Where a shaft is held against turning: its coupling if that carries torque, else where most of its torque enters or leaves beside the pair's gear, the gear of another
/// mesh or a load; of several that carry alike the first [mm]. NaN: nowhere.
/// @param torques  of the unit; of a pair without one nothing
double turning_hold(const ShaftsOfPair& shafts, int shaft, const UnitTorques& torques);
/// Tells the pair's shafts, see ShaftData::held_position.
/// @param shafts  as the study has them
void settle_turning_holds(ShaftsOfPair& shafts, const GearPair& pair);

}  // namespace flankwright
