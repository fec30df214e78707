#pragma once

#include <string>
#include <vector>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// A solved load case, by which a resolution is judged.
struct JudgedCase {
  std::string scene;
  double torque{not_given};  ///< on the pinion [N mm]
  const MeshModel* model{nullptr};
  const LoadedCycle* cycle{nullptr};
  const ResolvedCycle* resolved{nullptr};
};

/// The load cases of the design that the results show.
std::vector<JudgedCase> judged_cases(const StudyResults& results);

/// Doubles intervals or positions of results.study, whichever cause most of the largest error, unless the study gives them: as
/// analyse_resolved() does, over all load cases, with the limits of AutomaticResolution and Fidelity::resolution_accuracy. What these cases have come to goes to
/// FidelityChoice::levels. False where the accuracy is kept or nothing is left to refine.
/// @param most_doublings  more than one where a level costs much: it is passed over where its error, converging with order two, would not suffice
bool refine_resolution(const std::vector<JudgedCase>& cases, StudyResults& results, int most_doublings = 1);

/// Says in a note which load case and which of its figures has the largest error, where that exceeds Fidelity::resolution_accuracy. Nothing is said where the study
/// itself gives what brings the error, or asks for an accuracy, which is a requirement.
void note_what_stays_wide(const std::vector<JudgedCase>& cases, StudyResults& results);

/// States in results.fidelity_choice the errors of the resolution that has been reached, and whether the accuracy is kept. Nothing to do without a choice.
void state_resolution(StudyResults& results);

}  // namespace flankwright::studies
