#pragma once

#include "studies/analysis/study_results.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// The section "life" of results.json; only where results.life has a value.
Json life_json(const StudyResults& results);

}  // namespace flankwright::studies
