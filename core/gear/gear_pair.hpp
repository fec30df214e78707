#pragma once

#include <vector>

#include "core/base/error.hpp"
#include "core/gear/pair_geometry.hpp"

namespace flankwright {

/// Everything in the data that cannot be built, all at once; empty where make_gear_pair() will succeed. Fields carry the
/// names of the study file ("pinion.teeth", "pair.centre_distance").
std::vector<InvalidInput> find_problems(const PairData& data);

/// Builds the pair. Throws the first of find_problems().
GearPair make_gear_pair(const PairData& data);

}  // namespace flankwright
