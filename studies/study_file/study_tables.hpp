#pragma once

#include "studies/study_file/study_reading.hpp"

/// Inside the reader: the tables of a study whose keys are not fixed names.
namespace flankwright::studies {

/// [[scenes]], or the one nominal scene; each is the base with its overrides. Needs draft.base.
void read_scenes(StudyReading& reading);

/// analyse.gradients.
void read_gradients(StudyReading& reading);

/// The objective, the variables and the constraints of [optimise].
void read_optimise(StudyReading& reading);

/// [expect].
void read_expectations(StudyReading& reading);

}  // namespace flankwright::studies
