#pragma once

#include <vector>

#include "optimize/design/design_optimiser.hpp"

namespace flankwright {

/// What a design found by a search may change by, relative to its value, where its contact lines have four times the intervals [-]. Of damage, which grows with
/// a power of the stress (DesignOutput::growth), as many times more.
inline constexpr double change_by_intervals = 0.02;
/// Figures converge with order one at least: four times the intervals change them by at most this many times what twice as many do [-].
inline constexpr double four_times_by_twice = 1.5;
/// What twice the intervals may change a design by.
inline constexpr double change_by_doubling = change_by_intervals / four_times_by_twice;

/// Whether a finer look turns what a design was chosen by. The objective changes by more than an allowed share, or one of the load cases that are worst
/// together falls behind another by more than that, or a constraint that was kept is exceeded by more than half of it. Where no design keeps the constraints, one
/// plus the largest excess takes the objective's place. Of damage, DesignOutput::growth times as much is allowed.
/// @param report      as the search saw the design, in all load cases
/// @param seen        as the finer look sees it, in those of `scenes`
/// @param scenes      numbers of the load cases seen, rising
/// @param infeasible  no design keeps the constraints
/// @param change      allowed [-], > 0
bool is_turned(const DesignTask& task, const DesignReport& report, const DesignReport& seen, const std::vector<int>& scenes, bool infeasible,
               double change);

/// A design with twice the intervals along its contact lines.
struct FinerLook {
  /// The intervals are too few for what the design was chosen by: is_turned() by change_by_doubling.
  bool needs_more{false};
  /// Per constraint, what four times the intervals add to OutputConstraint::excess: four_times_by_twice of what twice as many do [-]. It is 0 for a constraint that no
  /// load case comes near to. Empty where a load case could not be analysed.
  std::vector<double> excess_changes;
};

/// Looks at a design with twice the intervals. Only those load cases are analysed that may decide: their objective comes within twice change_by_intervals of the worst, or a
/// constraint within it of its limit.
/// @param report      of a design, all of whose cycles are usable
/// @param infeasible  no design keeps the constraints
FinerLook look_finer(const DesignProblem& problem, const DesignReport& report, bool infeasible);

}  // namespace flankwright
