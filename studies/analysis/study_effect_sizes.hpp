#pragma once

#include <vector>

#include "core/base/progress_report.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Sizes as fidelity.effect_sizes asks for them, over the loaded results: all load cases of an analysis, those of the design after an
/// optimisation.
EffectSizes study_effect_sizes(const StudyResults& results, const ProgressReport& progress = {});

/// Switches off, before loads are analysed, what is estimated to lie below a budget in every load case together, see within_budget();
/// nothing where the study lists its effects by hand. What the estimates, made coarsely and to first order, propose is solved with and
/// without at the study's own resolution, and where a figure of headline(), harmonics in amplitude and phase, changes by more than its budget over a
/// safety of 1.25 the largest effect stays on; after two such refusals all stay.
/// @param results  with gears' structures and mesh positions made
/// @param budget   of each figure [-]; nothing is switched off where one of headline() has none
LeftOutEffects drop_small_effects(StudyResults& results, const std::vector<DesignScene>& scenes, const PerFigure& budget);

}  // namespace flankwright::studies
