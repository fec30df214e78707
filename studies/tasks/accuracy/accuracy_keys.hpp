#pragma once

#include <vector>

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Keys of [accuracy].
std::vector<SchemaKey> accuracy_keys();

/// Whether an outside curve has values and one load case that it belongs to. Needs the scenes.
void check_accuracy(StudyReading& reading);

}  // namespace flankwright::studies
