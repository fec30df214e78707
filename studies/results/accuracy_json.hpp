#pragma once

#include "studies/tasks/accuracy/fidelity_choice.hpp"
#include "studies/tasks/accuracy/ladder.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// Section `accuracy` of results.json: every rung beside the finest; see results.md.
Json ladder_json(const Ladder& ladder);
/// Section `accuracy_choice`: what `fidelity.accuracy` has chosen, its estimates and cost.
Json fidelity_choice_json(const FidelityChoice& choice);

}  // namespace flankwright::studies
