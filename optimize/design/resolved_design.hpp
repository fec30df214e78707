#pragma once

#include <functional>
#include <vector>

#include "core/fidelity/resolved_cycle.hpp"
#include "optimize/design/design_optimiser.hpp"

namespace flankwright {

/// Estimated discretisation errors of a DesignReport, entry for entry in its units; NaN where none was estimated.
struct DesignErrors {
  double objective{not_given};
  std::vector<double> scene_measures, constraint_values, later_objectives;
};

/// The error of an output in a scene that its resolved cycle does not state, such as a damage, in the output's unit inside and >= 0; NaN: not estimated.
using FurtherError = std::function<double(const ObjectiveTerm&, int scene)>;

/// Replaces a report's figures by those of resolved cycles, with their errors. The error of an objective is its change
/// when the measures of all scenes are as large, or as small, as their errors allow.
/// @param cycles         of the report's analysis, one a scene
/// @param further_error  nothing: what resolved cycles do not state is not estimated
DesignErrors resolve_report(const DesignProblem& problem, const std::vector<ResolvedCycle>& cycles, DesignReport& report,
                            const FurtherError& further_error = {});

/// Objectives of an analysis by its resolved cycles, one a scene, in outside units; errors as resolve_report() has them, with the same further errors.
std::vector<ResolvedValue> resolved_values(const DesignProblem& problem, const std::vector<Objective>& objectives, const DesignAnalysis& analysis,
                                           const std::vector<ResolvedCycle>& cycles, const FurtherError& further_error = {});

}  // namespace flankwright
