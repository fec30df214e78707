#pragma once

#include <string>
#include <vector>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Where contact first reaches a tip edge, before an optimisation and after it, and what that edge bears.
/// @param all  load cases, of which at least one has edge_contact
std::string edge_contact_note(const std::vector<LoadedResult>& all);

}  // namespace flankwright::studies
