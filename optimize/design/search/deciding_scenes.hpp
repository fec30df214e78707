#pragma once

#include <set>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"

namespace flankwright {

/// Whether a search may leave out scenes, as long as its result is held against all: what is minimised is the worst of them and consists of peaks at points,
/// as stresses and loads are. Not the transmission error: it has several optima, and other scenes lead to others. Not with bounds on outputs or
/// objectives: from a design beyond them every scene counts.
bool single_scenes_decide(const DesignTask& task);

/// The worst scenes of what is minimised: those whose measure is larger than the largest over `among`, or less below it than a share of it.
/// @param analysis  of all scenes, usable
/// @param near      the share [-], >= 0
/// @param among     scenes; empty: all of them
std::set<int> deciding_scenes(const DesignProblem& problem, const DesignAnalysis& analysis, double near, const std::set<int>& among = {});

/// The scenes with the largest measures of what is minimised.
std::set<int> worst_scenes(const DesignProblem& problem, const DesignAnalysis& analysis, int count);

}  // namespace flankwright
