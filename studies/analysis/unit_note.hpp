#pragma once

#include <string>
#include <vector>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// What makes figures of the unit doubtful, the first of: forces on a shaft that do not balance, a misalignment of the pair that is no small motion, and the other mesh
/// that is out of contact at one end of its face, in the load case where it is most, see MeshState::face_load_factor. Empty: nothing.
std::string unit_note(const StudyResults& results);

/// Bearings that carry nothing in some load case, a note for each: the shaft floats in the clearance there.
std::vector<std::string> idle_bearing_notes(const StudyResults& results);

}  // namespace flankwright::studies
