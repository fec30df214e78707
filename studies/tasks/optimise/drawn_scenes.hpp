#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/study/study.hpp"
#include "studies/tasks/optimise/assessment_table.hpp"

namespace flankwright::studies {

/// An operating state of the gears: what its scenes have in common that does not scatter, which is the torques, the speed and the working flank.
struct OperatingState {
  Scene scene;         ///< the first listed scene of the state, which stands for all of them
  double weight{1.0};  ///< of all its scenes, relative to those of the first state
};

/// The operating states of the listed scenes, in their order. Scenes that differ in nothing but misalignment, errors, weight and toleranced quantities are of
/// one state: points of one scatter.
std::vector<OperatingState> operating_states(const Study& study, const std::vector<SceneTolerance>& tolerances);

/// Scenes drawn from a study's tolerances. A draw is one pair of gears in one housing: a point of a scrambled Sobol sequence, which depends on the seed and the
/// number of the draw only. It has one scene in each operating state, with the same drawn values in all of them; Scene::draw is its number, from 0 on.
/// The weight is that of the state. A list of torques is run through in every drawn scene as in the listed one.
std::vector<Scene> draw_scenes(const Study& study, const DrawnScenes& drawn);
/// The same from tolerances other than the study's.
std::vector<Scene> draw_scenes(const Study& study, const std::vector<SceneTolerance>& tolerances, const DrawnScenes& drawn);

/// The first listed scene with every tolerance at Distribution::widest(), for decisions that must hold for every draw.
Scene widest_scene(const Study& study);

/// A value that its key does not accept.
struct RefusedDraw {
  std::string path;     ///< of the tolerance
  int draw{0};          ///< number of the draw, from 0 on
  double value{0.0};    ///< in the unit of a bare number, with what it is added to
  std::string allowed;  ///< values of the key
};

/// The first such value among the draws, nothing where the keys accept all of them. What is added to an amount of a modification may be as large as an amount
/// may be, either way.
std::optional<RefusedDraw> find_refused_draw(const Study& study, const DrawnScenes& drawn);

/// "drawn 12" of the draw 11.
std::string name_of_draw(int draw);

/// The load cases that the value of a draw is made of: ", each in 2 operating states (drive, coast), the worst of which counts"; empty where there is one.
std::string load_cases_in_words(const Study& study);

}  // namespace flankwright::studies
