#pragma once

#include <optional>
#include <vector>

#include "core/contact/gap/gap.hpp"
#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

/// The contact laws of a position in a condition: deviations move tip edges, see tip_edge_shift(). Empty where no law has an edge: then those of the
/// position hold.
std::vector<ContactLaw> laws_with_moved_edges(const MeshModel& model, const MeshPosition& at, const FlankCondition& condition);

/// MeshModel::contact_law() in a condition.
std::optional<ContactLaw> contact_law_in(const MeshModel& model, const ContactPoint& point, const FlankCondition& condition);

/// The largest contact pressure at a point, Hertz's sqrt(w E'/(pi R)) or that of a strip on an edge, that on the edge and the load there. All 0
/// without load.
/// @param law  null: Hertzian contact is left out, and with it any edge
StripContact::Peaks contact_stress(const MeshModel& model, const ContactPoint& point, const ContactLaw* law, double line_load);

}  // namespace flankwright
