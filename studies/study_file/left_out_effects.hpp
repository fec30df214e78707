#pragma once

#include <string>

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Refuses a key that the study varies, or differentiates by, while fidelity.effects leaves out the effect by which it acts.
/// @param asked_at  the key that asks: "sweep.parameters.misalignment.crossing"
/// @param path      the key that is varied: "misalignment.crossing"
void require_effect_of(StudyReading& reading, const std::string& asked_at, const std::string& path);

}  // namespace flankwright::studies
