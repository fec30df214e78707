#pragma once

#include <array>
#include <memory>
#include <optional>

#include "core/compliance/pair/pair_compliance.hpp"
#include "core/compliance/pair/pair_root_stress.hpp"
#include "studies/compliance/gear_refinement.hpp"
#include "studies/base/progress.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Both gears' structure and what it was made from.
struct GearStructures {
  std::shared_ptr<const PairCompliance> pair;  ///< null for "rigid" and "thin_slice", which need none
  std::shared_ptr<const PairRootStress> root_stress;  ///< null where the study does not want it
  std::optional<FiniteElementRuns> finite_elements;
  std::array<std::optional<GearRefinement>, 2> refinements;  ///< pinion, wheel; of "fitted" only

  const std::optional<GearRefinement>& refinement(Member m) const { return refinements[m == Member::Pinion ? 0 : 1]; }
};

/// The structure that a study's compliance model asks for, and its root stress. Root stress takes a finite-element run of
/// both gears, whatever the compliance is.
/// @throws InvalidInput  as solve_finite_elements() and gear_refinement()
GearStructures gear_structures(const Study& study, const GearPair& pair, const ProgressReport& progress);

}  // namespace flankwright::studies
