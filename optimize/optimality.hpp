#pragma once

#include <string>
#include <vector>

#include "optimize/epigraph_program.hpp"

namespace flankwright {

/// A constraint of the design at its optimum that its multiplier says is felt.
struct ActiveBound {
  EpigraphRow row;         ///< of the epigraph; for a variable's bound of kind Floor with scene -1
  int variable{-1};        ///< index where it is a bound of a variable, else -1
  int side{0};             ///< of a variable: -1 lower, 1 upper
  double multiplier{0.0};  ///< > 0, see Optimality
};

/// How nearly a design satisfies the first-order conditions of the task itself, whichever solver found it.
///
/// With the epigraph at that design, every u at its peak, rows c(y) <= 0 and bounds, the multipliers >= 0 are chosen
/// to make the conditions hold best:
///
///     minimise over lambda >= 0   |grad f + J' lambda|^2 + |c lambda|^2
///
/// over all rows and bounds within `reach` of being active. f is the objective in units of its start, variables count in their
/// ranges. A residual above 1e-4 at a point where no solver can descend is a kink that candidates do not describe: a contact
/// point about to lose or take up load, a relief's start that passes one.
struct Optimality {
  double residual{not_given};         ///< largest entry of grad f + J' lambda [-]
  double complementarity{not_given};  ///< largest |c lambda| [-]
  std::vector<ActiveBound> active;    ///< multipliers above 1e-6, largest first
  static constexpr double reach = 0.02;
};

/// @param x  scaled design
Optimality first_order_optimality(DesignProblem& problem, const Eigen::VectorXd& x);

}  // namespace flankwright
