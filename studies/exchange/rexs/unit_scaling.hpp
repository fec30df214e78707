#pragma once

#include <vector>

#include "core/compliance/shaft/unit_data.hpp"

namespace flankwright::studies::rexs {

/// Whether loads from outside and given torques of a unit in one condition are those of the reference times the ratio of both reference torques, to 1e-3
/// of the largest force, moment or torque.
/// Constant loads of the reference do not scale.
/// @pre both have a reference_torque and the same meshes
bool are_scaled(const UnitData& unit, const UnitData& reference);

/// Marks the loads of the reference that all other conditions have as well, at other torques, as constant: forces and moments to 1e-3 of theirs. Loads with a
/// torque about the shaft are none.
/// @pre all have a reference_torque
void mark_constant_loads(UnitData& reference, const std::vector<UnitData>& others);

}  // namespace flankwright::studies::rexs
