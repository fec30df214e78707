#pragma once

#include <memory>

#include "core/compliance/finite_element/gear_mesh.hpp"
#include "core/compliance/finite_element/influence_table.hpp"
#include "core/compliance/model/gear_structures.hpp"
#include "core/compliance/pair/pair_compliance.hpp"
#include "tests/benchmarks/contact_truth/contact_run.hpp"

namespace flankwright::contact_truth {

/// Influence values of one gear held at its bore as the outside model holds it, no motion of a shaft taken off: what is
/// compared is the same body. The program's own mesh and functionals. Values E m_n K with E = 1 in the mesh.
/// @param bore_radius   [mm]
/// @param plane_strain  no node moves along the axis
InfluenceTable held_at_bore(const GearPair& pair, Member member, double bore_radius, double poissons_ratio, const GearMeshOptions& mesh = {},
                            bool plane_strain = false);

/// Both gears of a task.
std::shared_ptr<const PairCompliance> held_structure(const ContactTask& task, const GearMeshOptions& mesh = {});

/// Structure and root stress of both gears by finite elements as a study has them whose bores are rigid, BodyHold::RigidBore, and as wide as the task's.
GearStructures rigid_bore_structures(const ContactTask& task);

}  // namespace flankwright::contact_truth
