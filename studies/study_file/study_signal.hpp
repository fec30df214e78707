#pragma once

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Reads the signal that load.spectrum names, counts it and stores the bins of the study; what is wrong with it becomes a problem. Each bin has the hours, revolutions
/// and mean speed of its torques; time at or below 0 is a bin without torque. Swings of the torque have no speed.
///
/// @param path  of the file, as the system finds it
void read_signal(StudyReading& reading, const std::string& path);

}  // namespace flankwright::studies
