#pragma once

#include "optimize/design/design_optimiser.hpp"

namespace flankwright {

/// What a search by two levels did on each.
struct LevelWork {
  MeshResolution resolution;
  int analyses{0};            ///< of the whole scene set
  double seconds{not_given};  ///< wall time
};

/// A design sought coarsely and finished finely.
struct TwoLevelDesign {
  DesignResult design;  ///< of the fine level: before, after, constraints, optimality; starts, optima and the first part of the history are the coarse level's
  LevelWork search, fine;
  double objective_seen_by_search{not_given};  ///< of the coarse optimum, as the coarse level has it, outside units
};

/// The same task with half the intervals along each contact line, and without steps: where a search may begin.
DesignTask coarser(DesignTask task);
/// Whether coarser() has at least this many intervals of the rule Graded: with fewer the order of designs is not kept.
inline constexpr int fewest_search_intervals = 4;
bool can_be_coarser(const DesignTask& task);

/// Searches with half the intervals from all starts, judges every optimum found at the task's own resolution, and goes on there from the best
/// by the finisher, whose active set needs few analyses near an optimum. All that is reported is of the fine level. Only rounding
/// takes place there alone.
/// @param problem  of the fine level
/// @throws InvalidInput as optimise_design()
TwoLevelDesign optimise_by_two_levels(DesignProblem& problem, const DesignOptions& options);

/// Goes on at the fine level from the problem's start, by the finisher; what it finds takes the place of the design's fine part.
void go_on(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found);

}  // namespace flankwright
