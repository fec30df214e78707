#pragma once

#include <string>
#include <vector>

#include "core/gear/gear_pair.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Warnings about a study before any result, one line each: settings that the compliance does not use, undercut, cut-off
/// contact, a transverse contact ratio below 1, teeth that would jam. First among the notes of the results.
std::vector<std::string> study_notes(const Study& study, const GearPair& pair);

}  // namespace flankwright::studies
