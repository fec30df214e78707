#pragma once

#include <vector>

#include "core/flank/modifications/modification.hpp"
#include "core/gear/gear_pair.hpp"
#include "studies/analysis/study_results.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/drawn_flank.hpp"

namespace flankwright::studies {

/// @throws InvalidInput where ISO 1328-1 does not cover the gear
FlankDrawing make_drawing(const GearPair& pair, Member member, const Modification& modification, const DrawingTerms& terms);

/// Both gears' drawings of what is to be ground, where the study names a class.
std::vector<FlankDrawing> drawings_of(const StudyResults& results);

/// An entry of `drawing` in results.json: traces, band widths and the sheet.
Json drawing_json(const FlankDrawing& drawing);

}  // namespace flankwright::studies
