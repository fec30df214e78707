#pragma once

#include <functional>
#include <optional>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// A load case solved with half the intervals at coarse_phases(), and its mesh, which lives on.
struct CoarseCycle {
  const MeshModel* mesh;
  LoadedCycle cycle;
};
/// That of a load case; nothing where there is none.
using CoarseCycleOf = std::function<std::optional<CoarseCycle>(const LoadedResult&)>;

/// Of all load cases of the results; nothing where the study does not ask for it. Stresses are those at the mesh positions.
/// @param coarse_of  for the errors of loss, film and temperatures; nothing: they are not estimated
std::optional<StudyLife> study_life(const StudyResults& results, const CoarseCycleOf& coarse_of = {});

}  // namespace flankwright::studies
