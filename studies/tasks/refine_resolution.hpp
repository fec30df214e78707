#pragma once

#include "studies/tasks/study_results.hpp"

namespace flankwright::studies {

/// An analysis that is left to choose its resolution refines it until headline_error() <= headline_accuracy in every load case [-], or up to
/// most_intervals and most_positions.
inline constexpr double headline_accuracy = 0.01;
inline constexpr int most_intervals = 48, most_positions = 128;

/// Doubles what brings most of the largest error, intervals or positions, as far as the study leaves them open, in results.study. False where the
/// accuracy is kept or nothing is left to refine; what then stays above it is said in a note, unless the study itself gives what brings it.
bool refine_resolution(StudyResults& results);

}  // namespace flankwright::studies
