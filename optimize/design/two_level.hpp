#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "optimize/design/design_optimiser.hpp"

namespace flankwright {

/// The work of a two-level search on each level.
struct LevelWork {
  MeshResolution resolution;
  std::int64_t cycles{0};     ///< of one scene each
  double seconds{not_given};  ///< wall time
};

/// The end of a search at a resolution whose order of designs a finer look confirmed: is_turned() was false. The design is shown as the finer look sees it. What makes
/// it an optimum, DesignResult::optimality, is of the search.
struct ConfirmedSearch {
  LevelWork work;                                ///< of the finisher at that resolution
  std::shared_ptr<const DesignProblem> problem;  ///< that was searched
  DesignReport design;                           ///< the best design met, before choices and steps, as the search saw it
  double objective_seen{not_given};              ///< of it, as the finer look sees it, at the positions, outside units
};

/// A design sought coarsely and finished finely.
struct TwoLevelDesign {
  DesignResult
      design;  ///< of the fine level: before, after, constraints, optimality; starts, optima and the first part of the history are the coarse level's
  LevelWork search, fine;
  double objective_seen_by_search{not_given};  ///< of the coarse optimum, as the coarse level has it, outside units
  std::optional<ConfirmedSearch> confirmed;    ///< where the finisher ended at a coarser resolution than `fine`, which then counts what came after
};

/// The resolution of a search: half the intervals of its task along each contact line, within these limits of the rule
/// Graded, and at most so many positions. With fewer the order of designs is not kept; with more an optimum is found no
/// better, for it is finished finely.
inline constexpr int fewest_search_intervals = 4, most_search_intervals = 6, most_search_positions = 32;
/// The same task for a search: coarser, with the structure to search by, and without steps.
DesignTask coarser(DesignTask task);
/// Whether coarser() keeps to fewest_search_intervals.
bool can_be_coarser(const DesignTask& task);

/// Searches coarsely from all starts, judges every optimum found at the task's own resolution, and continues there from
/// the best, see best_starts(), by the finisher, whose active set needs few analyses near an optimum. All reported values are of the fine
/// level. Rounding is done there only.
/// @param problem  of the fine level
/// @throws InvalidInput as optimise_design()
TwoLevelDesign optimise_by_two_levels(DesignProblem& problem, const DesignOptions& options);

/// The best design met, before choices and steps.
inline const DesignReport& exact_of(const TwoLevelDesign& found) { return found.design.exact ? *found.design.exact : found.design.after; }

/// The budgets that a design found has left of those of its search.
SolverOptions left_of(SolverOptions options, const DesignResult& found);

/// Designs from which a search at another resolution goes on, chosen from a design and the optima found beside it. First comes the design that exceeds the constraints
/// least; among equals, the one with the lowest objective. The design with the lowest objective of all follows where it is another: a search from there may
/// mend what it exceeds.
/// @param problem  of that resolution; it judges the designs
/// @param x_found  of the design, scaled
std::vector<Eigen::VectorXd> best_starts(DesignProblem& problem, const DesignResult& found, const Eigen::VectorXd& x_found);

/// Shows a design found at a coarser resolution by a finer one, without a search there.
/// @param problem  that was searched, or shown until now; afterwards the finer one
/// @param after, exact  DesignResult::after and ::exact by the finer problem
void confirm(DesignProblem& problem, DesignProblem finer, DesignReport after, std::optional<DesignReport> exact, TwoLevelDesign& found);

/// Shows the given design by the problem too. Does nothing where no search was confirmed.
void complete_confirmed(DesignProblem& problem, TwoLevelDesign& found);

/// Continues at the fine level from the problem's start by the finisher; the result replaces the design's fine part.
void go_on(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found);

/// The same from each of the starts; the result is the best: one that keeps the constraints before one that does not, then that of the lower objective.
/// @param starts  scaled, at least one
void go_on_from_best(DesignProblem& problem, const DesignOptions& options, const std::vector<Eigen::VectorXd>& starts, TwoLevelDesign& found);

/// What a search with DesignOptions::to_grind = false has left: chooses what can be ground of the design found.
void choose_what_to_grind(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found);

}  // namespace flankwright
