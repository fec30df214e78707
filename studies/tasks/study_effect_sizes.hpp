#pragma once

#include <vector>

#include "studies/tasks/study_results.hpp"

namespace flankwright::studies {

/// Sizes as fidelity.effect_sizes asks for them, over the loaded results: all load cases of an analysis, those of the design after an
/// optimisation.
EffectSizes study_effect_sizes(const StudyResults& results);

/// Switches off, before loads are analysed, what is estimated to lie below a budget in every load case together, see within_budget();
/// nothing where the study lists its effects by hand.
/// @param results  with gears' structures and mesh positions made
/// @param budget   relative error [-]; nothing is switched off where it is not above 0
void drop_small_effects(StudyResults& results, const std::vector<DesignScene>& scenes, double budget);

}  // namespace flankwright::studies
