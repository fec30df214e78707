#pragma once

#include "studies/analysis/study_run.hpp"

namespace flankwright::studies {

/// Searches the modifications of the study's [optimise], looks at the optimum finely and assesses it; the design before and after enter the
/// results with all their load cases.
void run_optimise(StudyRun& run);

}  // namespace flankwright::studies
