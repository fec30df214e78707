#pragma once

#include <string>
#include <vector>

#include "optimize/design/search/epigraph_program.hpp"

namespace flankwright {

/// A constraint that is active at the optimum by its multiplier.
struct ActiveBound {
  EpigraphRow row;         ///< of the epigraph; for a variable's bound of kind Floor with scene -1
  int variable{-1};        ///< index where it is a bound of a variable, else -1
  int side{0};             ///< of a variable: -1 lower, 1 upper
  double multiplier{0.0};  ///< > 0, see Optimality
  bool is_kink{false};     ///< the row bends at the design: its gradients on either side balance together
  double by_output{0.0};   ///< change of the row by its output [1/inside unit]; 0 where it has none
};

/// How nearly a design satisfies the first-order conditions of the task itself, whichever solver found it.
///
/// With the epigraph at that design, every u at its peak, rows c(y) <= 0 and bounds, the multipliers >= 0 are chosen
/// to make the conditions hold best:
///
///     minimise over lambda >= 0   |grad f + J' lambda|^2 + |c lambda|^2
///
/// over all rows and bounds within `reach` of being active, peaks within that of the objective as it is; variables' bounds only where more than 1e-4 remains without
/// them, so that a bound has no multiplier where multipliers are not unique.
///
/// A limit with room has no multiplier at an optimum. The least squares above would give it one all the same: where a search has left r of the gradient along
/// grad c, the least sum is at lambda = r |grad c| / (|grad c|^2 + c^2), for any room c. So limits on outputs, objectives and modifications and bounds of variables take part only
/// where a design in the neighbourhood, each variable changed by at most `neighbourhood` of its range, is at them to first order,
///
///     -c <= neighbourhood |grad c|_1 + DesignLog::tolerance;
///
/// where the conditions do not hold to 1e-4 in this way, in a neighbourhood ten and a hundred times as large, and at last all within `reach`: the conditions of
/// Goldstein, A., Math. Programming 13 (1977), that designs within a distance of the one at hand satisfy together. f is the objective in units of its start or the root of that, see ObjectiveBlock,
/// variables are scaled to their ranges.
///
/// Rows bend where a contact point is about to lose or take up load, or the start of a relief passes one; optima like
/// to lie there. Where the conditions do not hold to 1e-4 with the gradients at the design, gradients at its neighbours
/// (one variable changed by `neighbourhood` of its range) count as gradients of the same row as well: the conditions of
/// Clarke, F., Optimization and Nonsmooth Analysis, 1983, with the generalised gradient as Burke, Lewis & Overton, SIAM
/// J. Optim. 15 (2005), sample it. They are taken where the conditions then hold, and the rows that bend are marked.
struct Optimality {
  double residual{not_given};         ///< largest entry of grad f + J' lambda [-]
  double complementarity{not_given};  ///< largest |c lambda| [-]
  std::vector<ActiveBound> active;    ///< multipliers above `felt`, largest first
  Eigen::VectorXd steepest;           ///< of each design variable: largest entry of the gradients of active rows [-]
  double objective_scale{not_given};  ///< change of the objective with f, outside units: the objective of the start, unless f is a root of it
  static constexpr double reach = 0.02;
  static constexpr double felt = 1e-6;
  static constexpr double holds = 1e-4;          ///< satisfied where residual and complementarity are at most this
  static constexpr double neighbourhood = 1e-4;  ///< share of a variable's range, far below what can be ground
  /// Whether the first-order conditions hold.
  bool satisfied() const { return residual <= holds && complementarity <= holds; }
};

/// @param x  scaled design
Optimality first_order_optimality(DesignProblem& problem, const Eigen::VectorXd& x);

}  // namespace flankwright
