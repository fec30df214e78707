#pragma once

#include <string>
#include <vector>

#include "core/gear/gear_pair.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Normal backlash j_bn = j_wt cos(alpha_wt) cos(beta_b) [mm, ISO 21771]; below 0 the teeth overlap.
double normal_backlash(const GearPair& pair);

/// What a given centre distance leaves: "backlash 112 um on the working pitch circle, 105 um normal to the flanks ..."; empty where the
/// centre distance follows from the profile shifts.
std::string backlash_in_words(const GearPair& pair);

/// Warnings about a study before any result, one line each: settings that the compliance does not use, undercut, cut-off
/// contact, a transverse contact ratio below 1, teeth that would jam. First among the notes of the results.
std::vector<std::string> study_notes(const Study& study, const GearPair& pair);

}  // namespace flankwright::studies
