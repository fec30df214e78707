#pragma once

#include <string>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Where films are thinnest and contact is hottest on tip edges, and what the flanks have in the same load cases, or where sharp edges leave that open; empty where flanks
/// are worse.
/// @param results  with their life; load cases of a design before an optimisation do not count
std::string film_note(const StudyResults& results);

}  // namespace flankwright::studies
