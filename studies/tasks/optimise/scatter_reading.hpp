#pragma once

#include <vector>

#include "core/gear/gear_pair.hpp"
#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// What the flanks of both gears scatter by in a tolerance class of ISO 1328-1 (flank_tolerances.hpp): helix and profile slope, normal about zero and
/// cut off at the tolerance; the pitch, drawn tooth by tooth; and the form deviation as the longest wave that it can be, a crowning of either sign
/// whose height is normal about zero and cut off at f_fbetaT or f_falphaT. The form as a crowning is an assumption and no part of the standard.
/// @throws InvalidInput where the standard does not cover a gear
std::vector<SceneTolerance> class_tolerances(const GearPair& pair, int tolerance_class);

/// Tolerances of a study with those of a class in place of the ones that its own class gives; what optimise.tolerances says itself stays.
std::vector<SceneTolerance> with_class(const std::vector<SceneTolerance>& tolerances, const GearPair& pair, int tolerance_class);

/// Checks [optimise.scatter], and adds the tolerances of its class. After read_assessment().
void read_scatter(StudyReading& reading);

}  // namespace flankwright::studies
