#pragma once

#include <string>

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Adds to a loaded result how the shafts move at every position, "shafts", and "shaft_misalignment_um" to its summary, the mean over
/// the positions of what both shafts open the mesh by at +z; "unit" with the state of a gear unit, or of bearings with clearance. Only where results.shafts is not null.
void add_shaft_motion(const LoadedResult& loaded, const StudyResults& results, Json& json);

/// The misalignment of the mesh by shafts, bearings and housing in the load cases that govern, see governing_cases(): a line each, of an optimisation after it.
/// f_sh, which is "shaft_misalignment_um" [um]; the same over the common face width [urad]; and of a unit the part that other forces than the pair's make under
/// mean forces [um]. All have the sign of a mesh misalignment: + opens the mesh at +z. Empty where shafts are rigid.
/// @param width  of the column of scenes [characters]
std::string shaft_table(const StudyResults& results, std::size_t width);

}  // namespace flankwright::studies
