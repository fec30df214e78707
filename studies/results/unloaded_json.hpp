#pragma once

#include "studies/base/json_format.hpp"
#include "studies/analysis/unloaded_result.hpp"

namespace flankwright::studies {

/// The section `unloaded` of results.json for one scene.
Json unloaded_json(const UnloadedResult& unloaded, const GearPair& pair);

}  // namespace flankwright::studies
