#pragma once

#include <array>
#include <memory>
#include <optional>

#include "core/compliance/model/gear_correction.hpp"
#include "core/compliance/pair/pair_compliance.hpp"
#include "core/compliance/pair/pair_rim_motion.hpp"
#include "core/compliance/pair/pair_root_stress.hpp"

namespace flankwright {

/// Both gears' structure and what it was made from.
struct GearStructures {
  std::shared_ptr<const PairCompliance> pair;         ///< null for "rigid" and "thin_slice", which need none
  std::shared_ptr<const PairRootStress> root_stress;  ///< null where the task does not want it
  std::shared_ptr<const PairRimMotion> rim_motion;    ///< null unless `pair` has a gear on a web
  std::optional<FiniteElementRuns> finite_elements;
  PerGear<std::optional<GearCorrection>> corrections;  ///< of "fitted" only
  /// On the pair's other flanks, where they are another model: task_of_other_flanks(). `pair` and `root_stress` know them as well.
  std::shared_ptr<const GearStructures> other_flanks;
  std::vector<std::string> notes;  ///< library_notes(), and fits that did not converge
};

/// Solves, fits and joins what the task asks for. Root stress needs a finite-element run of both gears with every
/// model. Finite elements of gears of usual size take seconds and some gigabytes.
/// @throws InvalidInput  as solve_finite_elements() and gear_correction()
GearStructures build_compliance(const ComplianceTask& task, const ComplianceBuild& build = {});

}  // namespace flankwright
