#pragma once

#include <string>
#include <vector>

#include "studies/base/results_folder.hpp"
#include "studies/tasks/accuracy/ladder.hpp"

namespace flankwright::studies {

/// accuracy.csv and accuracy_orders.csv.
std::vector<NamedText> ladder_tables(const Ladder& ladder);

/// What the task prints: a line for each level.
std::string ladder_summary(const Ladder& ladder);

}  // namespace flankwright::studies
