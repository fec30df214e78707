#pragma once

#include <optional>
#include <vector>

#include "core/contact/gap/gap.hpp"
#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

inline bool has_rounded_tips(const GearPair& pair) { return pair.pinion.tip_edge_radius > 0.0 || pair.wheel.tip_edge_radius > 0.0; }

/// The contact laws of a position in a condition: deviations move tip edges, see TipEdgeShift. Edges that no load within these bounds reaches stay
/// where they are; empty where all do: then the laws of the position hold.
/// @param most  bounds of the line loads of all points [N/mm]
std::vector<ContactLaw> laws_with_moved_edges(const MeshPosition& at, const TipEdgeShift& shift, const Eigen::VectorXd& most);
/// The same of one position alone.
std::vector<ContactLaw> laws_with_moved_edges(const MeshModel& model, const MeshPosition& at, const FlankCondition& condition,
                                              const Eigen::VectorXd& most);

/// MeshModel::contact_law() in a condition.
std::optional<ContactLaw> contact_law_in(const MeshModel& model, const ContactPoint& point, const FlankCondition& condition);

/// The largest contact pressure at a point, Hertz's sqrt(w E'/(pi R)) or that of a strip on an edge, that on the edge and the load there. All 0
/// without load.
/// @param law  null: Hertzian contact is left out, and with it any edge
StripContact::Peaks contact_stress(const MeshModel& model, const ContactPoint& point, const ContactLaw* law, double line_load);

}  // namespace flankwright
