#pragma once

#include <string>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Load cases with loss, film, safeties and damage, and the sum over each spectrum; empty without.
/// @param width  of the column of names [characters]
std::string life_table(const StudyResults& results, std::size_t width);

/// A line for each load case and gear.
std::string life_csv(const StudyResults& results);

}  // namespace flankwright::studies
