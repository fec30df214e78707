#pragma once

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Whether [optimise] minimises or bounds the root stress.
bool minimises_root_stress(const Study& study);

/// Of two keys that say the same thing, one alone may be a variable. Holds for every study, whatever its task.
void check_variables(StudyReading& reading);

/// Variables, solver, outputs and scenes fit a search.
void check_optimise(StudyReading& reading);

}  // namespace flankwright::studies
