#pragma once

#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Refuses what [pinion.body] and [wheel.body] have too little of, and bodies that cannot be, whether or not the study's compliance knows of them.
void check_bodies(StudyReading& reading);

}  // namespace flankwright::studies
