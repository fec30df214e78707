#pragma once

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// A load case solved with half the intervals at coarse_phases(), and its mesh, which lives on.
struct CoarseCycle {
  const MeshModel* mesh;
  LoadedCycle cycle;
};

/// Loss, film, temperatures and safeties of one load case, without damage, which is a sum over a spectrum. Stresses of safeties are those of
/// LoadedResult::summary, film and temperatures of its positions and of LoadedResult::resolved between them.
/// @param loaded  usable; its rating, where it has one, gives the load factors of ISO 6336
/// @param coarse  for the errors of the loss; null: they are not estimated. Those of film and temperatures are in LoadedResult::resolved
CaseLife case_life(const MeshModel& model, const LifeModel& life, const LoadedResult& loaded, const CoarseCycle* coarse = nullptr);

}  // namespace flankwright::studies
