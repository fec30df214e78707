#pragma once

#include <vector>

#include "optimize/design/search/local_model.hpp"

namespace flankwright {

/// What would help where no design within the bounds of its variables keeps the bounds on outputs: the first-order conditions of the design
/// that exceeds them by least, DesignProblem::judged_by_excess(), say which limits hold the excess up and what would lower it.
struct Relaxation {
  /// A limit that holds the excess up in a scene. The weights of all sum to one.
  struct Limit {
    int constraint{-1};       ///< of the task's constraints, or
    int objective_bound{-1};  ///< of its objective bounds
    int scene{-1};
    double weight{not_given};
  };
  /// A change by one step that the task does not allow.
  struct Move {
    AssessedParameter parameter;
    double steps{1.0};         ///< 1 or -1: the direction that helps
    double gain{not_given};    ///< change of the excess where all else follows, < 0 [-, relative to the limit]
    double extent{not_given};  ///< over which the amount is spread, where the design gives none [mm]
    /// Whether a bound of a variable moves out; else the modification is not among the variables.
    bool moves_bound() const { return parameter.variable >= 0; }
  };
  double excess{not_given};   ///< the least one found [-, relative to the limit]
  std::vector<Limit> limits;  ///< heaviest first
  std::vector<Move> moves;    ///< largest gain first
};

/// Amounts that are not varied are tried from the value that the design has: crowning and relief towards more metal removed, slopes either way.
/// An amount without an extent is spread as rules_of_thumb() would, end relief over the smaller of 0.1 b and m_n, tip relief from the pitch point.
/// Root relief without an extent is left out, because tip relief of the mate does the same; so are topography shapes and the parabola.
/// @param problem  with bounds that can be exceeded by more or less, see has_smooth_excess()
/// @param design   the nearest one found, of which the excess is least among its neighbours; its load distributions converge
/// @param values   of the design variables [mm; parabolic_te 1/rad]
Relaxation find_relaxation(const DesignProblem& problem, const PerGear<Modification>& design, const std::vector<double>& values);

}  // namespace flankwright
