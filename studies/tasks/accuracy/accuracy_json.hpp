#pragma once

#include "studies/base/json_format.hpp"
#include "studies/tasks/accuracy/fidelity_hierarchy.hpp"

namespace flankwright::studies {

/// Section `accuracy` of results.json: every level beside the finest; see results.md.
Json hierarchy_json(const FidelityHierarchy& hierarchy);

}  // namespace flankwright::studies
