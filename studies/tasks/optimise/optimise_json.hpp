#pragma once

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// The part `optimise` of results.json; needs design and design_task.
Json optimise_json(const StudyResults& results);

}  // namespace flankwright::studies
