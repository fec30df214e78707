#pragma once

#include "studies/analysis/study_run.hpp"

namespace flankwright::studies {

/// Searches the modifications of the study's [optimise], analyses the optimum at the fine resolution and assesses it. The designs
/// before and after enter the results with all their load cases.
void run_optimise(StudyRun& run);

}  // namespace flankwright::studies
