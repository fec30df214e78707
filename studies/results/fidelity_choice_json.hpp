#pragma once

#include <string>

#include "studies/analysis/fidelity_choice.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// Section `accuracy_choice`: what `fidelity.accuracy` has chosen, its estimates and cost.
Json fidelity_choice_json(const FidelityChoice& choice);

/// The choice in one line, for the terminal.
std::string fidelity_choice_summary(const FidelityChoice& choice);

/// Errors as percentages, under the names of the figures, and the largest as "worst".
Json errors_json(const PerFigure& shares);

/// Values of the figures, with their units.
Json figures_json(const CycleFigures& figures);

}  // namespace flankwright::studies
