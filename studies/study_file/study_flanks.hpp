#pragma once

#include "studies/study_file/study_reading.hpp"

/// Inside the reader: how flanks were generated and measured, which single keys do not tell.
namespace flankwright::studies {

/// Puts the keys of each gear's `generation` together; what is missing or belongs to another kind becomes a problem.
void read_generation(StudyReading& reading);

/// Reads the grid files that the study names and fits them. Does nothing while the study has problems: a grid stands on the pair.
void read_grids(StudyReading& reading);

}  // namespace flankwright::studies
