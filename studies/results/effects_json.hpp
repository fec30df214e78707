#pragma once

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// `effects`: which are on, why, what each cost and how large it is.
Json effects_json(const StudyResults& results);

}  // namespace flankwright::studies
