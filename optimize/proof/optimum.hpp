#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimize/proof/local_model.hpp"

namespace flankwright {

/// How the objective answers to one parameter, outside units.
struct Sensitivity {
  ProofParameter parameter;
  double less{not_given}, more{not_given};  ///< change by one step down and up, all else held
  bool can_less{true}, can_more{true};      ///< false: the step would leave the bounds of a design variable
  /// Tolerances only: change by one step up where the design is optimised anew, to first order: the slope of the Lagrangian.
  double optimised_anew{not_given};
};

/// What holds an optimum where it is: multipliers that balance the gradients of all that is active,
///
///     sum_j y_j grad c_j + sum_i m_i grad h_i + upper bounds - lower bounds = 0,   all of them >= 0,
///
/// c_j the leading candidates of the governing scenes, h_i of bounded outputs and sums, in variables scaled to their ranges. They are
/// recovered from the design alone, as the non-negative least-squares solution, so that they are there whatever the solver was, and
/// what is left over says how far from first-order optimal the design is.
struct Optimum {
  struct Scene {
    int scene{-1};
    double weight{not_given};  ///< share in the objective's slope: of the worst case >= 0 and one together; else that of the aggregate
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
    int constraint{-1};      ///< of the task's modification constraints
    bool upper{false};
    double gain{not_given};  ///< change of the objective where the limit moves out by one step (as of its first modification), <= 0
  };
  std::vector<Scene> scenes;            ///< heaviest first; those without weight left out
  std::vector<Bound> bounds;            ///< largest gain first; every variable at a bound
  std::vector<Constraint> constraints;  ///< largest gain first
  std::vector<Sum> sums;                ///< largest gain first
  /// Largest component of the sum above over the variables' ranges, as a share of the objective [-]; 0 is first-order optimal.
  double residual{not_given};
  std::vector<Sensitivity> sensitivities;  ///< in the order of the parameters
};

/// What may have a multiplier: candidates this near to their peak, scenes to the worst, outputs and sums to their limit, variables to their
/// bound, as shares of the objective, the limit and the range. The rows |slack * multiplier| of the least squares keep multipliers
/// to what really touches, as far as the solver brought it there.
inline constexpr double near_within = 0.02;
/// A multiplier above this is felt, and a variable within this share of its range stands at its bound.
inline constexpr double felt = 1e-6, at_bound = 1e-4;

/// Scenes of a conditional value at risk have the weights of aggregate_weights(), which at a tie are one choice of several.
/// @param parameters  as the model has them, the design variables among them
/// @param values      of the design variables [mm; parabolic_te 1/rad], in their order
Optimum find_optimum(const DesignProblem& problem, const LocalModel& model, const std::vector<ProofParameter>& parameters,
                     const std::vector<double>& values);

}  // namespace flankwright
