#pragma once

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// The `sweep` section of results.json; see results.md. Five significant digits in the response maps, all digits elsewhere.
Json sweep_json(const StudyResults& results);

}  // namespace flankwright::studies
