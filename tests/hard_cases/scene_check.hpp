#pragma once

#include <cstdint>
#include <string>

namespace flankwright::hard_cases {

/// What became of one scene.
struct SceneVerdict {
  enum Kind { Passed, Refused, Failed } kind{Failed};
  std::string why{"not examined"};  ///< refused: what the user reads; failed: which property does not hold
};

/// Analyses a study of one scene, unloaded and under load, with floating-point traps set, and judges the results:
///
/// - nothing is thrown but InvalidInput (then it is refused, as a user's study would be);
/// - no number is NaN or infinite; loads are not negative;
/// - the residual of the optimality conditions is below its bound (LoadOptions::tolerance) and forces balance the torque;
/// - f_t lies between the first touch and what the nearest point would yield if it carried everything alone;
/// - a position has no contact points only where tooth contact analysis finds no pair that meets there either;
/// - the unloaded transmission error is no more than all amounts, errors and displacements together can move the flanks, unless a tip reaches
///   below the mate's form circle.
///
/// `flankwright run` on the same text does the same analyses, with pattern, ratings and tables on top.
/// @param name  stands for the file in messages
SceneVerdict examine(const std::string& study, const std::string& name);

/// Writes a failed scene as a study with the reason, seed and index in its first lines; returns its path.
std::string save_scene(const std::string& folder, const std::string& study, std::uint64_t seed, std::uint64_t index, const std::string& why);

}  // namespace flankwright::hard_cases
