#pragma once

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Objectives, variables, ties and constraints of [optimise].
void read_optimise(StudyReading& reading);

}  // namespace flankwright::studies
