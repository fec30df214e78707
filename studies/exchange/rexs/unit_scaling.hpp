#pragma once

#include "core/compliance/shaft/unit_data.hpp"

namespace flankwright::studies::rexs {

/// Whether loads from outside and given torques of a unit in one condition are those of the reference times the ratio of both reference torques, to 1e-3
/// of the largest force, moment or torque.
/// @pre both have a reference_torque and the same meshes
bool are_scaled(const UnitData& unit, const UnitData& reference);

}  // namespace flankwright::studies::rexs
