#pragma once

#include <optional>
#include <string>

#include "optimize/sampling/distribution.hpp"
#include "optimize/sampling/drawn_pitch.hpp"

namespace flankwright::studies {

/// A key of the scenes, or of the modifications as they are ground, that scatters.
struct SceneTolerance {
  std::string path;                       ///< as the study names it: "misalignment.mesh_misalignment"
  std::string in_words;                   ///< "normal, mean 0, deviation 6"
  Distribution distribution;              ///< of the value in the unit of a bare number
  bool added{false};                      ///< to what the nominal scene or the design has, else in its place
  std::optional<PitchTolerance> pitch{};  ///< as SweepParameter::pitch
  bool of_class{false};                   ///< from the class of [optimise.scatter]
};

}  // namespace flankwright::studies
