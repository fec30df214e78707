#pragma once

#include <string>
#include <vector>

#include "core/gear/gear_pair.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// What a given centre distance and tooth thickness allowances leave: "backlash 112 um on the working pitch circle (j_wt), 105 um normal to the
/// flanks (j_bn) ..."; empty where the centre distance follows from the profile shifts and there are no allowances.
std::string backlash_in_words(const GearPair& pair);

/// Leads so steep that the tool, which touches beside its nominal point there, takes more than ContactShift knows: R f'^2/2.
std::vector<std::string> steep_lead_notes(const PerGear<Modification>& modification, const GearPair& pair);

/// Warnings about a study before any result, one line each: settings that the compliance does not use, undercut, cut-off
/// contact, a transverse contact ratio below 1, teeth that would jam. First among the notes of the results.
std::vector<std::string> study_notes(const Study& study, const GearPair& pair);

}  // namespace flankwright::studies
