#pragma once

#include "core/compliance/shaft/unit_data.hpp"
#include "core/compliance/shaft/unit_state.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// A gear unit as used: shafts, meshes, loads, joints, housing.
Json unit_json(const UnitData& unit);

/// A gear unit under the mean forces of a load case: loaded[].unit.
Json unit_state_json(const UnitState& state);

}  // namespace flankwright::studies
