#pragma once

#include <string>
#include <vector>

#include "optimize/design/design_optimiser.hpp"
#include "studies/study/study.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

/// The constraints of a study that a design violates, a sentence each.
/// @param problem  whose design it is
std::vector<std::string> violated_constraints(const DesignProblem& problem, const OptimiseTable& asked, const DesignReport& design);

/// Adds to the requirements that were not met: an optimisation that ended early, constraints of outputs and of modifications that its design violates.
/// @param problem  whose design it is
void add_unmet_by_design(const DesignProblem& problem, const OptimiseTable& asked, const DesignResult& design, std::vector<std::string>& unmet);

}  // namespace flankwright::studies
