#pragma once

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Doubles intervals or positions, whichever cause most of the largest error, unless the study gives them, in results.study: as
/// analyse_resolved() does, over all load cases, with the limits of AutomaticResolution. False where the accuracy is kept or nothing is left to refine; what then stays above it is said in a note, unless the study itself gives what brings it.
bool refine_resolution(StudyResults& results);

}  // namespace flankwright::studies
