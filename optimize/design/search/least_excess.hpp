#pragma once

#include <vector>

#include "optimize/design/search/local_run.hpp"

namespace flankwright {

/// How far seek_least_excess() goes where the search from the nearest design known does not end within the limits.
struct LeastExcessOptions {
  SolverOptions solver;                 ///< budgets are those of all searches together
  std::vector<Eigen::VectorXd> others;  ///< further starts, scaled
  bool with_objective{true};            ///< whether the objective decides among designs of the same excess
};

/// What searches for the least excess over the limits of a task have found, where no design that keeps them was met.
struct LeastExcess {
  Eigen::VectorXd x;         ///< scaled design
  double excess{not_given};  ///< DesignProblem::violation() at x [-]; it keeps the limits where this is at most DesignLog::tolerance
  bool ended_well{false};    ///< whether the search from the nearest design known ended by itself, not by a budget or a failure
  int evaluations{0}, failures{0};
  std::vector<SolverStep> history;  ///< of the searches that led to x, by what the task itself minimises
};

/// Seeks the design that exceeds the limits by least (DesignProblem::judged_by_excess()), each search a local one:
///
/// 1. from `nearest`. Where its end keeps the limits, that is all.
/// 2. from the other starts in parallel, each with an equal part of what is left of the budget. The end with the least excess is taken, or where others exceed the
///    limits by the same (`same_excess`), the one of these with the least objective.
/// 3. where no end keeps the limits, from that end for the objective, while the excess stays the same. A minimax optimum is often flat, so that designs of the
///    same excess may differ much in the objective.
///
/// The least excess found need not be the least there is.
///
/// @param problem  with a smooth excess, see DesignProblem::has_smooth_excess()
/// @param nearest  the design of the least excess known, scaled
LeastExcess seek_least_excess(DesignProblem& problem, const Eigen::VectorXd& nearest, const LeastExcessOptions& options);

/// An excess e is the same as a lower one e0 where (1 + e) <= (1 + same_excess) (1 + e0) [-]: a search is ended where it gains less, see run_local().
inline constexpr double same_excess = 1e-5;

}  // namespace flankwright
