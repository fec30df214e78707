#pragma once

#include <string>
#include <vector>

#include "core/fidelity/effect_sizes.hpp"
#include "core/load/cycle/cycle_figures.hpp"

namespace flankwright::studies {

/// The size of an effect in that load case of a study in which it is largest.
struct SizeInStudy {
  std::string scene;
  double torque{not_given};           ///< on the pinion [N mm]
  EffectSize size;                    ///< its seconds those of all load cases
  int positions{0}, solved_again{0};  ///< of an estimate over all load cases, see EstimatedSize
};

/// Sizes of the effects of a study, an entry for each that is on and changes a loaded mesh.
struct EffectSizes {
  std::vector<SizeInStudy> estimated;  ///< empty: none asked for
  std::vector<SizeInStudy> exact;      ///< by leaving each out, at the study's own resolution; empty: not asked for
};

/// The entry of that name, null where there is none.
const SizeInStudy* size_of(const std::vector<SizeInStudy>& sizes, const std::string& name);

/// Effects that an analysis leaves out, and their estimated change together.
struct LeftOutEffects {
  std::vector<std::string> names;
  PerFigure error{};  ///< shares, worst over the load cases, see figure_differences(); 0 where nothing is left out
};

}  // namespace flankwright::studies
