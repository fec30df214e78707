#pragma once

#include <string>
#include <vector>

#include "studies/tasks/accuracy/fidelity_choice.hpp"
#include "studies/tasks/accuracy/ladder.hpp"
#include "studies/base/results_folder.hpp"

namespace flankwright::studies {

/// accuracy.csv, a line a rung, and accuracy_orders.csv.
std::vector<NamedText> ladder_tables(const Ladder& ladder);

/// What a run prints: the rungs with cost and error, those of the Pareto front marked.
std::string ladder_summary(const Ladder& ladder);
/// One line: what was chosen for an accuracy, the estimate and the cost.
std::string fidelity_choice_summary(const FidelityChoice& choice);

}  // namespace flankwright::studies
