#pragma once

#include <vector>

#include "core/base/error.hpp"
#include "core/compliance/shaft/unit_data.hpp"

namespace flankwright {

/// Gears of one shaft that take the same place without being one gear: other teeth, module, angles or hand.
/// @param shafts  gears on shafts that are there
std::vector<InvalidInput> find_place_problems(const ShaftsOfPair& shafts, const GearPair& pair);

/// Shafts and gears that contradict each other: axes, places along them, gears of a loop that cannot turn, gears of two shafts in one place. The first kind
/// that there is.
/// @param shafts  without any other problem
std::vector<InvalidInput> find_layout_problems(const ShaftsOfPair& shafts, const GearPair& pair);

}  // namespace flankwright
