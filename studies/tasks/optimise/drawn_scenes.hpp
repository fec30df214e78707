#pragma once

#include <vector>

#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Scenes drawn from a study's tolerances: the nominal (first) one with each toleranced key at its place in a point of a scrambled Sobol
/// sequence. Scene i depends on the seed and its number only. Weight 1; a list of torques is run through in every drawn scene as in the nominal one.
std::vector<Scene> draw_scenes(const Study& study, const DrawnScenes& drawn);
/// The same from tolerances other than the study's.
std::vector<Scene> draw_scenes(const Study& study, const std::vector<SceneTolerance>& tolerances, const DrawnScenes& drawn);

}  // namespace flankwright::studies
