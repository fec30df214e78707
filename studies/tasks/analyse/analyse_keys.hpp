#pragma once

#include <vector>

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Keys of [analyse].
std::vector<SchemaKey> analyse_keys();

/// analyse.gradients: keys that a loaded mesh has derivatives by.
void read_gradients(StudyReading& reading);

/// What is asked for can be had: derivatives by what acts, of gears that yield.
void check_gradients(StudyReading& reading);

}  // namespace flankwright::studies
