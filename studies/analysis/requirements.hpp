#pragma once

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Adds to the requirements that were not met (exit code 1), one line each: load cases in which nothing touches, or whose loads did not converge.
void add_unmet_by_load_cases(StudyResults& results);

}  // namespace flankwright::studies
