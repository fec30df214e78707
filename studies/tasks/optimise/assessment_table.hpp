#pragma once

/// The assessment of an optimum that a study asks for: [optimise.comparison], [optimise.validation].
namespace flankwright::studies {

/// Scenes drawn from the study's tolerances.
struct DrawnScenes {
  int samples{0};
  unsigned long seed{1};
};

struct AssessmentTable {
  bool rules{true};        ///< compare with the rules of thumb
  double variants{0.0};    ///< analyses of a full-factorial search for each analysis of the optimiser; 0: none
  DrawnScenes validation;  ///< that the optimum is tried on
  DrawnScenes scenes;      ///< that the optimiser sees beside those listed
};

}  // namespace flankwright::studies
