#pragma once

#include <vector>

#include "optimize/design/search/optimality.hpp"

namespace flankwright {

/// The active constraints of an optimum in terms of the task: the multipliers of first_order_optimality(), which
/// balance the gradients of all that is active, whatever the solver was,
///
///     sum_j y_j grad c_j + sum_i m_i grad h_i + upper bounds - lower bounds = 0,   all of them >= 0,
///
/// c_j the leading candidates of the governing scenes, h_i of bounded outputs, objectives and sums. A limit that the design leaves room has no multiplier, see
/// Optimality, and is not among them.
struct Optimum {
  struct Scene {
    int scene{-1};
    double weight{not_given};  ///< weight in the objective's slope; they sum to one; below 0 where mean + k sigma falls with the scene
  };
  /// A design variable at a bound.
  struct Bound {
    int variable{-1};
    bool upper{false};
    double gain{not_given};  ///< change of the objective where the bound moves out by one step and all else follows, <= 0 [outside units]
  };
  /// A bounded output at its limit.
  struct Constraint {
    int constraint{-1};
    double gain{not_given};  ///< change of the objective where the limit moves out by one per cent and all else follows, <= 0
  };
  /// A bounded sum of modifications at its limit.
  struct Sum {
    int constraint{-1};  ///< of the task's modification constraints
    bool upper{false};
    double gain{not_given};  ///< change of the objective where the limit moves out by one step (as of its first modification), <= 0
  };
  /// An earlier objective of a list at the limit that it keeps.
  struct Objective {
    int bound{-1};           ///< of the task's objective bounds
    double gain{not_given};  ///< change of the objective where the limit moves out by one per cent and all else follows, <= 0
  };
  std::vector<Scene> scenes;            ///< heaviest first; those without weight left out
  std::vector<Bound> bounds;            ///< largest gain first; every variable at a bound
  std::vector<Constraint> constraints;  ///< largest gain first
  std::vector<Sum> sums;                ///< largest gain first
  std::vector<Objective> objectives;    ///< largest gain first
  double residual{not_given};           ///< Optimality::residual: a share of the start's objective [-]; 0 is first-order optimal
  /// Accuracy of the optimum's objective [outside units]: a smaller gain is treated as zero. The residual, or `asked` where
  /// it is smaller, of the start's objective.
  double resolution{not_given};
  double value{not_given};  ///< objective of the design [outside units]

  static constexpr double asked = 1e-6;     ///< first-order residual that is as good as none
  static constexpr double at_bound = 1e-4;  ///< a variable within this fraction of its range is at its bound
};

/// @param problem     of a single objective; of a list the last one's, with the limits of those before it
/// @param optimality  of the design
/// @param values      of the design variables [mm; parabolic_te 1/rad], in their order
Optimum find_optimum(const DesignProblem& problem, const Optimality& optimality, const std::vector<double>& values);

}  // namespace flankwright
