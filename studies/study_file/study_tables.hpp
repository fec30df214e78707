#pragma once

#include "studies/study_file/study_reading.hpp"

/// Inside the reader: the tables of a study whose keys are not fixed names.
namespace flankwright::studies {

/// [[scenes]], or the one nominal scene; each is the base with its overrides. Needs builder.base.
void read_scenes(StudyReading& reading);

/// [expect].
void read_expectations(StudyReading& reading);

}  // namespace flankwright::studies
