#pragma once

#include <string>

#include "studies/run_study.hpp"

namespace flankwright::studies {

/// Text of results.json for a finished study. Units are in the key names; a number that was not computed is null.
/// README.md describes every section.
std::string results_json(const StudyResults& results);

/// Version of the program, "0.1.0".
const char* version();

}  // namespace flankwright::studies
