#pragma once

#include <string>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// A load case in which the teeth yield so much that deflections are not small against them, in words; empty where none does. Shafts, bearings and bodies may yield more.
std::string deflection_note(const StudyResults& results);

}  // namespace flankwright::studies
