#pragma once

#include <string>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Which other mesh of the unit is out of contact at one end of its face, in the load case where it is most, see MeshState::face_load_factor; empty: none.
std::string unit_note(const StudyResults& results);

}  // namespace flankwright::studies
