#pragma once

#include <functional>
#include <optional>

#include "studies/analysis/case_life.hpp"

namespace flankwright::studies {

/// That of a load case; nothing where there is none.
using CoarseCycleOf = std::function<std::optional<CoarseCycle>(const LoadedResult&)>;

/// Of all load cases of the results; nothing where the study does not ask for it. Stresses are those at the mesh positions.
/// @param coarse_of  for the errors of loss, film and temperatures; nothing: they are not estimated
std::optional<StudyLife> study_life(const StudyResults& results, const CoarseCycleOf& coarse_of = {});

}  // namespace flankwright::studies
