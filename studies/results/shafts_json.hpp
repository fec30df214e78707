#pragma once

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Adds to a loaded result how the shafts move at every position, "shafts", and "shaft_misalignment_um" to its summary, the mean over
/// the positions of what both shafts open the mesh by at +z; "unit" with the state of a gear unit, or of bearings with clearance. Only where results.shafts is not null.
void add_shaft_motion(const LoadedResult& loaded, const StudyResults& results, Json& json);

}  // namespace flankwright::studies
