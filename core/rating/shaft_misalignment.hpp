#pragma once

#include <vector>

#include "core/compliance/pair/pair_rim_motion.hpp"
#include "core/compliance/shaft/shaft_pair.hpp"
#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// The shafts as they are in a load case: on the flanks that touch, linearised at its torque.
ShaftPair shafts_under(const ShaftPair& shafts, const MeshModel& model, double pinion_torque);

/// Motions of both shafts under the loads of every position of a cycle; NaN where a gear has no shaft, or there is no load distribution.
/// @param shafts  shafts_under() of the load case
std::vector<PerGear<ShaftMotion>> shaft_motions(const ShaftPair& shafts, const MeshModel& model, const LoadedCycle& cycle);

/// What the motions at a position together open the mesh by at +z, over the common face, as Misalignment::mesh_misalignment does [mm]; a gear without a shaft
/// adds nothing. NaN where there is no load distribution.
double opened_by(const ShaftPair& shafts, const PerGear<ShaftMotion>& motions);

/// f_sh, the mean of opened_by() over the positions of a cycle [mm]; NaN where one of them has no load distribution.
/// @param motions  shaft_motions()
double shaft_misalignment(const ShaftPair& shafts, const std::vector<PerGear<ShaftMotion>>& motions);

/// What the rims of gears on webs open the mesh by at +z under a line load that is even along all lines of a position, at the loaded teeth, mean over the model's positions:
/// as f_sh a misalignment that the loads bring [mm]. In proportion to the force; 0 without rims.
/// @param force  normal to the flanks [N]
double rim_opening(const PairRimMotion& rims, const MeshModel& model, double force);

}  // namespace flankwright
