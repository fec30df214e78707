#pragma once

#include "studies/study_file/study_reading.hpp"

/// Part of the reader: conditions between several keys.
namespace flankwright::studies {

/// Keys that must be there, and keys of which a file may give only one.
void check_presence(StudyReading& reading);

/// The pair can be built: hands, pitch lists and find_problems(). Only where its own keys were without a problem.
void check_pair(StudyReading& reading);

/// Reliefs have an extent, a designed parabola has a flank, and finite elements can be made of the gears.
void check_flanks(StudyReading& reading);

}  // namespace flankwright::studies
