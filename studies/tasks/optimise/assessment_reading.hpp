#pragma once

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Reads [optimise.tolerances]: keys of the scenes with distributions as read_distribution() has them; "pinion.error" and
/// "wheel.error" with a tolerance class for helix_slope, profile_slope and pitch together; "pinion.bearing_clearance" and
/// "wheel.bearing_clearance" as { clearance = um, span = mm }, by which that gear's shaft may tilt by up to clearance / span either
/// way, uniformly and on top of what the scene has, as crossing and as intersecting.
void read_assessment(StudyReading& reading);

}  // namespace flankwright::studies
