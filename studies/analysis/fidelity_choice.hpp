#pragma once

#include <string>
#include <vector>

#include "core/fidelity/resolution_level.hpp"
#include "studies/analysis/fidelity_level.hpp"
#include "studies/analysis/effect_sizes.hpp"

namespace flankwright::studies {

/// A candidate model with its estimated error.
struct ModelCandidate {
  std::string name;           ///< "thin_slice"
  PerFigure error{};          ///< relative to the more expensive model, worst over the load cases; NaN where it was not computed
  double seconds{not_given};  ///< processor time of all load cases, coarsely resolved [s]
  bool chosen{false};
};

/// What was chosen for `fidelity.accuracy`: the models before the run, the resolution by the run itself. With the estimated errors behind the choice.
struct FidelityChoice {
  double accuracy{not_given};  ///< asked for [-]
  Fidelity fidelity;
  int positions{0};
  /// Settings given by the study are kept, and count as exact.
  bool compliance_given{false}, gap_given{false}, quadrature_given{false}, positions_given{false};
  std::vector<ModelCandidate> compliances, gaps;  ///< candidates; empty where given
  /// Estimated shares, worst over the load cases of the design that is shown; of the resolution: of quadrature and positions together.
  PerFigure compliance_error{}, gap_error{}, quadrature_error{}, position_error{}, resolution_error{};
  LeftOutEffects left_out;              ///< by the run, see drop_small_effects()
  std::string governing;                ///< scene of the load case with the largest error of the resolution
  double governing_torque{not_given};   ///< its torque [N mm]
  std::vector<ResolutionLevel> levels;  ///< resolutions of the run, the last one is shown; each of the load case with the largest error
  int failures{0};                      ///< positions without a usable load distribution: nothing is known
  bool kept{false};                     ///< headline(error()) <= accuracy
  double choosing_seconds{not_given};   ///< wall time of choosing the models, with finite elements where they were not kept

  /// Errors of compliance, gap, discretisation and left-out effects together. They are independent and each is estimated on
  /// the safe side, so their squares add up. NaN where no error could be estimated.
  PerFigure error() const;
  /// Remainder of the accuracy in each quantity, available for leaving out small effects; 0 where the accuracy is not kept.
  PerFigure effects_budget() const;
};

/// Chooses the cheapest compliance and gap with which an accuracy can be kept in every quantity of headline(): transmission error, its harmonics in amplitude
/// and phase, contact stress.
///
/// - compliance: "thin_slice" where it is, coarsely resolved, within half of the accuracy of "fitted"; "fitted" where fit_error() is
///   within 0.7 of the accuracy; else "fe", which counts as exact here;
/// - gap: "plane_of_action" where the gap over the whole surface changes quantities by less than 0.7 of the remaining
///   accuracy; else "whole_surface";
/// - differences between models are multiplied by a safety of 1.25, because they are computed at a coarse resolution;
/// - resolution: Fidelity::resolution_accuracy is what both leave. The run refines to it, see refine_resolution(), and state_resolution() says what it has reached.
///
/// Finite elements are solved only for the models that are compared, not for the size of an effect.
/// @param runner  with the study's load cases
FidelityChoice choose_models(LevelRunner& runner, const ProgressReport& progress);

/// One line saying that the accuracy is not kept.
std::string unmet_accuracy(const FidelityChoice& choice);

/// The study with the chosen models where it does not give them, and the accuracy that they leave to its resolution.
Study with_models(Study study, const FidelityChoice& choice);

}  // namespace flankwright::studies
