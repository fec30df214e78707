#pragma once

#include <string>
#include <vector>

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

/// The models and resolution chosen for `fidelity.accuracy`, with the estimated errors behind the choice.
struct FidelityChoice {
  double accuracy{not_given};  ///< asked for [-]
  Fidelity fidelity;
  int positions{0};
  /// Settings given by the study are kept, and count as exact.
  bool compliance_given{false}, gap_given{false}, quadrature_given{false}, positions_given{false};
  std::vector<ModelCandidate> compliances, gaps;  ///< candidates; empty where given
  /// Estimated shares, worst over the load cases; of the resolution: of quadrature and positions together, see Discretisation::error().
  PerFigure compliance_error{}, gap_error{}, quadrature_error{}, position_error{}, resolution_error{};
  LeftOutEffects left_out;             ///< by the run, see drop_small_effects()
  std::string governing;               ///< scene of the load case that needs the finest resolution
  double governing_torque{not_given};  ///< its torque [N mm]
  Discretisation discretisation;       ///< of the governing load case
  int failures{0};                     ///< positions without a usable load distribution: nothing is known
  bool kept{false};                    ///< headline(error()) <= accuracy
  double choosing_seconds{not_given};  ///< wall time, with finite elements where they were not kept

  /// Errors of compliance, gap, discretisation and left-out effects together. They are independent and each is estimated on
  /// the safe side, so their squares add up.
  PerFigure error() const;
  /// Remainder of the accuracy in each quantity, available for leaving out small effects; 0 where the accuracy is not kept.
  PerFigure effects_budget() const;
};

/// Chooses the cheapest compliance, gap, quadrature and mesh positions whose estimated errors together keep an accuracy in
/// every quantity of headline(): transmission error, its harmonics in amplitude and phase, contact stress.
///
/// - compliance: "thin_slice" where it is, coarsely resolved, within half of the accuracy of "fitted"; "fitted" where fit_error() is
///   within 0.7 of the accuracy; else "fe", which counts as exact here;
/// - gap: "plane_of_action" where the gap over the whole surface changes quantities by less than 0.7 of the remaining
///   accuracy; else "whole_surface";
/// - differences between models are multiplied by a safety of 1.25, because they are computed at a coarse resolution;
/// - resolution: choose_discretisation() of all load cases together, each quantity within the remaining accuracy. It tries
///   at most 48 intervals and 128 positions, and ends before where neither can bring the error down; kept is then false.
///
/// Finite elements are solved only for the models that are compared, not for the size of an effect.
/// @param runner  with the study's load cases
FidelityChoice choose_fidelity(LevelRunner& runner, const ProgressReport& progress);

/// One line saying that the accuracy is not kept.
std::string unmet_accuracy(const FidelityChoice& choice);

/// The study with the choice for all settings that it does not give.
Study with_choice(Study study, const FidelityChoice& choice);

}  // namespace flankwright::studies
