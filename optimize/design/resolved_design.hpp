#pragma once

#include <vector>

#include "core/fidelity/resolved_cycle.hpp"
#include "optimize/design/design_optimiser.hpp"

namespace flankwright {

/// Estimated discretisation errors of a DesignReport, entry for entry in its units; NaN where none was estimated.
struct DesignErrors {
  double objective{not_given};
  std::vector<double> scene_measures, constraint_values, later_objectives;
};

/// Puts what resolved cycles show in place of a report's figures, and says how sure they are. An objective over the scenes is off by as
/// much as it changes when the measures of all scenes are as large, or as small, as their errors allow.
/// @param cycles  of the report's analysis, one a scene
DesignErrors resolve_report(const DesignProblem& problem, const std::vector<ResolvedCycle>& cycles, DesignReport& report);

}  // namespace flankwright
