#pragma once

#include <vector>

#include "optimize/design/problem/design_problem.hpp"

namespace flankwright {

/// The load cases of every draw, as indices of the scenes, in the order in which draws first occur. A scene that belongs to no draw is one by itself. Of a
/// load spectrum only the first load case is listed where the objective is a sum over it.
std::vector<std::vector<int>> draws_of(const std::vector<DesignScene>& scenes, bool over_spectrum);

/// The value of each draw: the measures of its load cases, aggregated with their weights. NaN where a load case has none.
/// @param draws     as draws_of() lists them
/// @param measures  of every scene
std::vector<double> draw_measures(const std::vector<std::vector<int>>& draws, const std::vector<DesignScene>& scenes, const Aggregation& within,
                                  const std::vector<double>& measures);

/// A statistic over the draws of a problem, whose load cases count as `task.within_draw` says; outside unit.
double statistic_over_draws(const DesignProblem& problem, const Objective& objective, const DesignAnalysis& analysis);

}  // namespace flankwright
