#pragma once

#include <vector>

#include "core/base/error.hpp"
#include "core/compliance/shaft/unit_data.hpp"

namespace flankwright {

/// Everything in the data that cannot be: what find_problems() says of a shaft; gears, loads and bearings on no shaft or outside it; shafts that can
/// move as rigid bodies; torques that do not balance; what find_place_problems() and
/// find_layout_problems() say. Fields are keys of a study, "unit.meshes.0.shaft_1".
std::vector<InvalidInput> find_problems(const ShaftsOfPair& shafts, const GearPair& pair);

}  // namespace flankwright
