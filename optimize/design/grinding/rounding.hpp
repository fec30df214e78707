#pragma once

#include <Eigen/Core>
#include <compare>
#include <functional>

#include "optimize/design/problem/design_problem.hpp"

namespace flankwright {

/// A design on the grinder's steps.
struct RoundedDesign {
  Eigen::VectorXd x;                         ///< scaled; variables with a step are multiples of it within their bounds
  double objective{not_given};               ///< outside units
  double constraint_violation{not_given};    ///< [-]
  double modification_violation{not_given};  ///< its part by limits on modifications [-]
  int analyses{0};                           ///< of the whole scene set, including those that ended at a scene too bad for a worst case
};

/// Best neighbour of a design on the steps of its variables. The search begins at the corner of the cell of steps around the design that a LocalModel
/// has least. Single variables and then pairs of them move by one step as long as that helps (feasible first, then the objective; of infeasible designs the one that exceeds the limits on modifications by less: such a design can be ground). Where the rounded
/// design is then infeasible or worse than the design itself by more than dear_rounding, the other corners are tried, the most promising first, and
/// single variables and pairs move by up to two steps.
///
/// A design is not analysed where the model has it above the best by more than dear_rounding and by more than it was above any design that was analysed.
/// At the end every variable becomes 0 that the objective does not feel: by all of them together it rises by no more than idle_share.
///
/// With scalarised objectives, or a budget of one analysis, there is no model: the search begins at the nearest steps and analyses every neighbour.
/// No global search: the best of all combinations may be missed, not by much near a flat optimum.
/// @param most_analyses  >= 1; the search ends in order with the best so far
RoundedDesign round_design(DesignProblem& problem, const Eigen::VectorXd& x, int most_analyses);

/// What a model that costs less than an analysis says of a design.
struct StepFigure {
  double modification_violation{0.0};  ///< by limits on modifications, which decide first [-]; 0 where the design keeps them
  double violation{0.0};               ///< by any constraint [-]; 0 where the design keeps all
  double objective{0.0};
  auto operator<=>(const StepFigure&) const = default;
};

/// Least design on the steps of the variables by such a function, from the nearest steps on: single variables and then pairs of them move by one step as long
/// as that helps. At the end every variable becomes 0 that the function does not feel, all together within idle_share.
/// @param x  scaled; variables without a step keep their values
Eigen::VectorXd least_on_steps(const DesignProblem& problem, const Eigen::VectorXd& x,
                               const std::function<StepFigure(const Eigen::VectorXd&)>& figure);

/// Relative rise of the objective by rounding beyond which more of the grid is searched [-].
inline constexpr double dear_rounding = 0.01;

/// Relative rise of the objective by all amounts that are left out [-]: less than an analysis knows it to.
inline constexpr double idle_share = 1e-3;

/// True where some variable has a step.
bool has_steps(const DesignTask& task);

}  // namespace flankwright
