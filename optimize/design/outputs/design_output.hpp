#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "optimize/design/outputs/output_row.hpp"

namespace flankwright {

/// All rows, in the order of Output.
std::span<const DesignOutput> design_outputs();
const DesignOutput& design_output(Output output);

/// Whether 1 / output is, like an output, the largest of smooth functions, and finite: of the least of several, and of one that is smooth itself and not 0.
bool has_reciprocal(const DesignOutput& row);

/// The term that a study names, with weight 1; nothing where there is none of that name.
std::optional<ObjectiveTerm> find_term(std::string_view name);
/// The names of all terms, those with orders each.
std::vector<std::string> term_names();

}  // namespace flankwright
