#pragma once

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// CSV tables of the unloaded contact, see csv_tables().
std::string unloaded_csv(const StudyResults& results);         ///< one line a pair and position
std::string transfers_csv(const StudyResults& results);        ///< one line for each transfer point
std::string bearing_pattern_csv(const StudyResults& results);  ///< one line a grid point of a flank

/// The part of the printed summary about unloaded contact, a line a scene.
/// @param width  of the first column
std::string unloaded_summary(const StudyResults& results, std::size_t width);

}  // namespace flankwright::studies
