#pragma once

#include <limits>
#include <optional>

#include "core/rating/contact_peaks.hpp"

namespace flankwright {

/// Whether a loaded point's contact strip reaches its tip edge, rounded or sharp.
bool reaches_tip_edge(const MeshPosition& at, const LoadedPosition& loaded, std::size_t point);
/// Whether any of a cycle does.
bool reaches_tip_edge(const MeshModel& model, const LoadedCycle& cycle);

/// The least torque at which contact reaches a tip edge.
struct EdgeContactStart {
  double torque{not_given};     ///< on the pinion [N mm]; 0: without load already
  Member gear{Member::Pinion};  ///< whose edge it is
  double phase{not_given};      ///< of the mesh position [base pitches]
};

/// Sought by halving between no torque and the given one, at one position of the model after the other, to two thousandths of that torque. Contact that
/// leaves an edge again as the torque grows is not looked for.
/// @param pinion_torque  [N mm], > 0
/// @param of             the gear whose edges count
/// @param earlier_than   a torque at which contact is known to reach an edge at another position [N mm], > 0: only starts below it by a thousandth of
///                       `pinion_torque` are sought
/// @returns nothing where contact reaches no edge at the lesser of both torques, or its loads were not found
std::optional<EdgeContactStart> edge_contact_start(const MeshModel& model, const FlankCondition& condition, double pinion_torque, Member of,
                                                   double earlier_than = std::numeric_limits<double>::infinity());

/// The same between mesh positions, where an edge touches first as a rule: a start found at one of them is sought on at phases beside it, first three quarters of the way
/// to both neighbours and then as much closer. The edges of its gear count: the other gear's touch elsewhere in the cycle.
/// @param spacing  of the mesh positions [base pitches]
EdgeContactStart edge_contact_start_near(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque, EdgeContactStart start,
                                         double spacing);

}  // namespace flankwright
