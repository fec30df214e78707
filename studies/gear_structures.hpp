#pragma once

#include <memory>
#include <optional>

#include "core/compliance/pair_compliance.hpp"
#include "core/compliance/pair_root_stress.hpp"
#include "studies/finite_elements.hpp"
#include "studies/progress.hpp"
#include "studies/study.hpp"

namespace flankwright::studies {

/// Both gears' structure and what it was made from.
struct GearStructures {
  std::shared_ptr<const PairCompliance> pair;  ///< null for "rigid" and "thin_slice", which need none
  std::shared_ptr<const PairRootStress> root_stress;  ///< null where the study does not want it
  std::optional<FiniteElementRuns> finite_elements;
};

/// The structure that a study's compliance model asks for, and its root stress. Root stress takes a finite-element run of
/// both gears, whatever the compliance is.
/// @throws InvalidInput  as solve_finite_elements()
GearStructures gear_structures(const Study& study, const GearPair& pair, const ProgressReport& progress);

}  // namespace flankwright::studies
