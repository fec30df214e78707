#pragma once

#include <string>
#include <vector>

#include "studies/base/results_folder.hpp"
#include "studies/tasks/accuracy/fidelity_hierarchy.hpp"

namespace flankwright::studies {

/// accuracy.csv and accuracy_orders.csv.
std::vector<NamedText> hierarchy_tables(const FidelityHierarchy& hierarchy);

/// Summary on the terminal: a line for each level.
std::string hierarchy_summary(const FidelityHierarchy& hierarchy);

}  // namespace flankwright::studies
