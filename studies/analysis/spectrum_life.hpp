#pragma once

#include <optional>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Of all load cases of the results; nothing where the study does not ask for it. Stresses are those at the mesh positions.
std::optional<StudyLife> study_life(const StudyResults& results);

}  // namespace flankwright::studies
