#pragma once

#include <functional>
#include <vector>

#include "optimize/design/resolved_design.hpp"
#include "optimize/design/two_level.hpp"

namespace flankwright {

/// Resolves the cycles of a design's analysis, one a scene: seeks the extremes between its positions.
using DesignResolver = std::function<std::vector<ResolvedCycle>(const DesignAnalysis&)>;

/// The design variables, inside their bounds, that no active peak feels: Optimality::steepest is at most Optimality::holds.
///
/// The stress of a tooth pair that carries everything does not depend on a relief that lies elsewhere on its flanks. The relief decides at which
/// phase the pair comes to carry everything, and so which stress it has then. Peaks at given positions see that only when the phase passes one
/// of them: as a function of the relief they are a staircase, and every tread is a stationary point.
/// @param x  the scaled design that the optimality is of
std::vector<int> unfelt_variables(const Optimality& optimality, const Eigen::VectorXd& x);

/// Continues a search along those variables by the figures with extremes between the positions, which fall and rise without treads. The method
/// needs no gradients (COBYLA): the phase of an extreme moves. Only variables are taken of which a step of 2 % of the range lowers the objective.
/// `found` has the better design afterwards, its optimality stays that of the search at positions, and its message says what was done.
/// Does nothing for lists of objectives and scalarised ones.
void search_between_positions(DesignProblem& problem, const DesignResolver& resolve, TwoLevelDesign& found);

/// Continues a search over all variables whose design exceeds a limit between the positions and there only: a tip edge that touches for a moment is felt by
/// none of them, so that no limit at positions is tight enough. The same method; `found` has the better design afterwards, or that of the least excess, with
/// its own optimality. Of a list of objectives the last is minimised, and the earlier ones have limits too. Does nothing for scalarised ones.
/// @param problem  with the limits as they are asked for
void keep_limits_between_positions(DesignProblem& problem, const DesignResolver& resolve, TwoLevelDesign& found);

}  // namespace flankwright
