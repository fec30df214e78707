#pragma once

#include <vector>

#include "optimize/design/search/local_model.hpp"

namespace flankwright {

/// Sensitivity of the objective to one parameter, outside units.
struct Sensitivity {
  AssessedParameter parameter;
  double less{not_given}, more{not_given};  ///< change by one step down and up, all else held
  bool can_less{true}, can_more{true};      ///< false: the step would leave the bounds of a design variable
  /// Tolerances only: change by one step up where the design is optimised anew, to first order: the slope of the Lagrangian.
  double optimised_anew{not_given};
  int intervals{0};  ///< along each contact line, by which it was analysed
};

/// Sensitivities of an optimum to its variables, then to tolerance_parameters(). A tolerance that moves the mesh takes two meshes of its own in every
/// scene. All tolerances are therefore analysed by no more than some intervals, at the same positions. What has a multiplier at the optimum is then
/// represented by its counterpart(), and the multipliers lambda change by as little as balances the variables there as at the optimum:
///
///     minimise |lambda' - lambda|   subject to   J'^T lambda' = J^T lambda     (J, J': active_slopes() by the variables)
/// @param problem    as for find_optimum()
/// @param optimality of the design
/// @param design     the optimum; its load distributions converge
/// @param values     of the design variables [mm; parabolic_te 1/rad], in their order
/// @param most_tolerance_intervals  >= 1
std::vector<Sensitivity> find_sensitivities(const DesignProblem& problem, const Optimality& optimality, const PerGear<Modification>& design,
                                            const std::vector<double>& values, int most_tolerance_intervals);

}  // namespace flankwright
