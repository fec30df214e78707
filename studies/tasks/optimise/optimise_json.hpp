#pragma once

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// The part `optimise` of results.json.
Json optimise_json(const StudyResults& results);

}  // namespace flankwright::studies
