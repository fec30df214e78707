#pragma once

#include <string>
#include <vector>

#include "optimize/design/design_optimiser.hpp"
#include "studies/study/study.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"
#include "studies/tasks/optimise/scatter.hpp"

namespace flankwright::studies {

/// The constraints of a study that a design violates, a sentence each.
/// @param problem  whose design it is
std::vector<std::string> violated_constraints(const DesignProblem& problem, const OptimiseTable& asked, const DesignReport& design);

/// Adds to the requirements that were not met: an optimisation that ended early, constraints of outputs and of modifications that its design violates.
/// @param problem  whose design it is
void add_unmet_by_design(const DesignProblem& problem, const OptimiseTable& asked, const DesignResult& design, std::vector<std::string>& unmet);

/// Limits over drawn gears that the prediction of the design exceeds by more than draws tell apart, a sentence each.
std::vector<std::string> limits_exceeded_over_draws(const ScatterResult& result, const DesignTask& task, const Aggregation& statistic);

}  // namespace flankwright::studies
