#pragma once

#include <string>
#include <vector>

#include "core/load/cycle_figures.hpp"
#include "core/load/effect_sizes.hpp"
#include "optimize/design_task.hpp"
#include "studies/study.hpp"

namespace flankwright::studies {

struct StudyResults;

/// The size of an effect in that load case of a study in which it is largest.
struct SizeInStudy {
  std::string scene;
  double torque{not_given};  ///< on the pinion [N mm]
  EffectSize size;           ///< its seconds those of all load cases
  int positions{0}, solved_again{0};  ///< of an estimate over all load cases, see EstimatedSize
};

/// How large the effects of a study are, one entry each that is on and changes a loaded mesh.
struct EffectSizes {
  std::vector<SizeInStudy> estimated;  ///< empty: none asked for
  std::vector<SizeInStudy> exact;      ///< by leaving each out, at the study's own resolution; empty: not asked for
};

/// The entry of that name, null where there is none.
const SizeInStudy* size_of(const std::vector<SizeInStudy>& sizes, const std::string& name);

/// Sizes as fidelity.effect_sizes asks for them, over the loaded results: all load cases of an analysis, those of the design after an
/// optimisation.
EffectSizes study_effect_sizes(const StudyResults& results);

/// Effects that an analysis does without, and what they would change together.
struct LeftOutEffects {
  std::vector<std::string> names;
  PerFigure error{};  ///< shares, worst over the load cases, see figure_differences(); 0 where nothing is left out
};

/// Switches off, before loads are analysed, what is estimated to lie below a budget in every load case together, see within_budget();
/// nothing where the study lists its effects by hand. What the estimates, made coarsely and to first order, propose is solved with and
/// without at the study's own resolution, and where a figure of headline(), harmonics in amplitude and phase, changes by more than its budget over a
/// safety of 1.25 the largest effect stays on; after two such refusals all stay.
/// @param results  with gears' structures and mesh positions made
/// @param budget   of each figure [-]; nothing is switched off where one of headline() has none
LeftOutEffects drop_small_effects(StudyResults& results, const std::vector<DesignScene>& scenes, const PerFigure& budget);

}  // namespace flankwright::studies
