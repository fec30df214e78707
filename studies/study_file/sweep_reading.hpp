#pragma once

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// [sweep]: its parameters, and whether the design can be made. A parameter that the study gives no value stands at its median in the
/// study itself, the nominal sample. Needs the scenes, and problems of the pair known.
void read_sweep(StudyReading& reading);

}  // namespace flankwright::studies
