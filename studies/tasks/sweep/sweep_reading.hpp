#pragma once

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// The parameters of [sweep].
void read_sweep(StudyReading& reading);

/// Whether the samples can be made. A parameter without a value in the study takes its median in the study itself, the nominal
/// sample. Needs the scenes, and problems of the pair known.
void check_sweep(StudyReading& reading);

}  // namespace flankwright::studies
