#pragma once

#include <optional>

#include "optimize/design/design_optimiser.hpp"
#include "optimize/design/pareto.hpp"
#include "optimize/design/resolved_design.hpp"
#include "optimize/design/two_level.hpp"
#include "studies/analysis/study_results.hpp"
#include "studies/tasks/optimise/assessment.hpp"
#include "studies/tasks/optimise/scatter.hpp"

namespace flankwright::studies {

/// Evaluations of a search at its two levels, and its own view of the optimum.
struct SearchWork {
  LevelWork search, fine;
  double objective_seen_by_search{not_given};  ///< of the optimum on the coarse level, outside units
  std::optional<ConfirmedSearch> confirmed;    ///< TwoLevelDesign::confirmed
  double objective_at_positions{not_given};  ///< of what is to be ground, at the fine level's positions alone: what it is compared by, outside units
};

/// What an optimisation found.
struct OptimiseResults {
  DesignTask task;
  DesignResult design;  ///< its figures as they are shown: with extremes between the positions
  SearchWork search_work;
  DesignErrors before_errors, after_errors;  ///< of the design's reports
  std::optional<ParetoFront> front;
  Assessment assessment;                 ///< of the design
  std::optional<ScatterResult> scatter;  ///< where the design was chosen over draws
};

/// @param results  of an optimisation that has run
inline const OptimiseResults& optimised(const StudyResults& results) { return *results.found<OptimiseResults>(); }

}  // namespace flankwright::studies
