#pragma once

#include <string>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// A load case in which teeth and bodies deform so much that deflections are not small against them, in words; empty where none does.
std::string deflection_note(const StudyResults& results);

}  // namespace flankwright::studies
