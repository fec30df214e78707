#pragma once

#include "optimize/design/design_optimiser.hpp"

namespace flankwright {

/// What a design found by a search may change by, relative to its value, where its contact lines have twice the intervals [-]. Of damage, which grows with a
/// power of the stress (DesignOutput::growth), as many times more.
inline constexpr double change_by_intervals = 0.02;

/// Whether the intervals along the contact lines are too few for what a design was chosen by. Twice as many change the objective by more than
/// change_by_intervals, or a constraint that was kept is exceeded by more than half of that. Where no design keeps the constraints, one plus the
/// largest excess takes the objective's place. Only those load cases are analysed that may decide: their objective comes within twice the change of the worst, or a constraint
/// within it of its limit.
/// @param report      of a design, all of whose cycles are usable
/// @param infeasible  no design keeps the constraints
bool needs_more_intervals(const DesignProblem& problem, const DesignReport& report, bool infeasible);

}  // namespace flankwright
