#pragma once

#include "studies/base/progress.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Does the study's task, of a sweep the nominal sample alone (see run_sweep()). Never prints.
/// @throws InvalidInput where the study cannot be analysed after all
StudyResults run_study(const Study& study, const ProgressReport& progress = {});

}  // namespace flankwright::studies
