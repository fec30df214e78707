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
  double by_output{0.0};   ///< change of the row by its output [1/inside unit]; 0 where it has none
};

/// How nearly a design satisfies the first-order conditions of the task itself, whichever solver found it.
///
/// With the epigraph at that design, every u at its peak, rows c(y) <= 0 and bounds, the multipliers >= 0 are chosen
/// to make the conditions hold best:
///
///     minimise over lambda >= 0   |grad f + J' lambda|^2 + |c lambda|^2
///
/// over all rows and bounds within `reach` of being active; variables' bounds only where more than 1e-4 is left without them, so that a bound has
/// no share where multipliers are not unique. f is the objective in units of its start, variables count in their
/// ranges. A residual above 1e-4 at a point where no solver can descend is a kink that candidates do not describe: a contact
/// point about to lose or take up load, a relief's start that passes one.
struct Optimality {
  double residual{not_given};         ///< largest entry of grad f + J' lambda [-]
  double complementarity{not_given};  ///< largest |c lambda| [-]
  std::vector<ActiveBound> active;    ///< multipliers above `felt`, largest first
  double objective_scale{not_given};  ///< the objective of the start that f is counted in, outside units
  static constexpr double reach = 0.02;
  static constexpr double felt = 1e-6;
};

/// @param x  scaled design
Optimality first_order_optimality(DesignProblem& problem, const Eigen::VectorXd& x);

}  // namespace flankwright
