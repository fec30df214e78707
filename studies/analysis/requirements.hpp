#pragma once

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Adds to the requirements that were not met (exit code 1), one line each: load cases in which nothing touches, or whose loads did not converge.
void add_unmet_by_load_cases(StudyResults& results);

/// The constraints of a study that a design violates, a sentence each.
/// @param problem  whose design it is
std::vector<std::string> violated_constraints(const DesignProblem& problem, const OptimiseTable& asked, const DesignReport& design);

/// The same of an optimisation: one that ended early, constraints of outputs and of modifications that the design violates.
/// @param problem  whose design it is
void add_unmet_by_design(const DesignProblem& problem, StudyResults& results);

}  // namespace flankwright::studies
