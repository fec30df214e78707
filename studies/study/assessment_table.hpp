#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimize/sampling/distribution.hpp"
#include "optimize/sampling/drawn_pitch.hpp"

/// The assessment of an optimum that a study asks for: [optimise.comparison], [optimise.validation], [optimise.tolerances].
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

/// Scenes drawn from the tolerances.
struct DrawnScenes {
  int samples{0};
  unsigned long seed{1};
};

struct AssessmentTable {
  bool rules{true};        ///< compare with the rules of thumb
  double variants{0.0};    ///< analyses of a full-factorial search for each analysis of the optimiser; 0: none
  DrawnScenes validation;  ///< that the optimum is tried on
  DrawnScenes scenes;      ///< that the optimiser sees beside those listed
  std::vector<SceneTolerance> tolerances;
};

}  // namespace flankwright::studies
