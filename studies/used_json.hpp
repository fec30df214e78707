#pragma once

#include "studies/json_format.hpp"
#include "studies/run_study.hpp"

namespace flankwright::studies {

/// The section `used` of results.json: what the run took, defaults and derived values included.
Json used_json(const StudyResults& results);

}  // namespace flankwright::studies
