#pragma once

#include "studies/study_file/study_reading.hpp"

/// Part of the reader: generated and measured flanks, which need more than single keys.
namespace flankwright::studies {

/// Puts the keys of each gear's `generation` together; what is missing or belongs to another kind becomes a problem.
void read_generation(StudyReading& reading);

/// Reads the grid files that the study names and fits them. Does nothing while the study has problems, because a grid depends on the pair.
void read_grids(StudyReading& reading);

}  // namespace flankwright::studies
