#pragma once

#include <string>
#include <vector>

#include "studies/analysis/fidelity_level.hpp"
#include "studies/analysis/effect_sizes.hpp"

namespace flankwright::studies {

/// A model that was considered, and what it was estimated to do.
struct ModelCandidate {
  std::string name;            ///< "thin_slice"
  PerFigure error{};           ///< shares beside the dearer model, worst over the load cases; NaN where it was not worked out
  double seconds{not_given};   ///< processor time of all load cases, coarsely resolved [s]
  bool chosen{false};
};

/// What `fidelity.accuracy` has made of a study's fidelity, and the evidence.
struct FidelityChoice {
  double accuracy{not_given};  ///< asked for [-]
  Fidelity fidelity;
  int positions{0};
  /// What the study itself says stays, and counts as exact.
  bool compliance_given{false}, gap_given{false}, quadrature_given{false}, positions_given{false};
  std::vector<ModelCandidate> compliances, gaps;  ///< considered; empty where given
  /// Estimated shares, worst over the load cases; of the resolution: of quadrature and positions together, see Discretisation::error().
  PerFigure compliance_error{}, gap_error{}, quadrature_error{}, position_error{}, resolution_error{};
  LeftOutEffects left_out;       ///< by the run, see drop_small_effects()
  std::string governing;         ///< scene of the load case that asked for the finest resolution
  double governing_torque{not_given};  ///< its torque [N mm]
  Discretisation discretisation; ///< of the governing load case
  int failures{0};               ///< positions without a usable load distribution: nothing is known
  bool kept{false};              ///< headline(error()) <= accuracy
  double choosing_seconds{not_given};  ///< wall time, with finite elements where they were not kept

  /// Compliance, gap, discretisation and what was left out together: causes that have nothing to do with each other, each estimated on the
  /// safe side, so that squares add up.
  PerFigure error() const;
  /// What the estimates leave of the accuracy in each figure, for effects that are too small to matter; 0 where it is not kept.
  PerFigure effects_budget() const;
};

/// Chooses the cheapest compliance, gap, quadrature and mesh positions whose estimated errors, taken together, keep an accuracy in every
/// figure that a mesh is judged by, headline(): transmission error, its harmonics in amplitude and phase, contact stress.
///
/// - compliance: "thin_slice" where it is, coarsely resolved, within half of the accuracy of "fitted"; "fitted" where fit_error() is
///   within 0.7 of the accuracy; else "fe", which has no error in this account;
/// - gap: "plane_of_action" where the whole surface's gap changes figures by less than 0.7 of what is left; else "whole_surface";
/// - differences between models are multiplied by a safety of 1.25, as they are seen at a coarse resolution;
/// - the rest: choose_discretisation() of all load cases together, each figure within what the models leave of it.
///
/// The finite elements it asks for are those of the models that it compares, and none for what an effect does.
/// @param runner  with the study's load cases
FidelityChoice choose_fidelity(LevelRunner& runner, const ProgressReport& progress);

/// That an accuracy is not kept, in one line.
std::string unmet_accuracy(const FidelityChoice& choice);

/// The study with a choice in place of what it left open.
Study with_choice(Study study, const FidelityChoice& choice);

}  // namespace flankwright::studies
