#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/analysis/study_results.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

/// What to ask for where a search was free to load a tip edge more than any flank, because neither its objective nor a constraint has contact stress in it;
/// nothing where it was not free to, or has not done so.
/// @param all  load cases, those of the design found with the name "after"
std::optional<std::string> edge_advice(const OptimiseTable& asked, const std::vector<LoadedResult>& all);

}  // namespace flankwright::studies
