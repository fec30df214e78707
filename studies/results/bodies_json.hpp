#pragma once

#include <string>

#include "studies/analysis/study_results.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// A gear's body as used, of `used` in results.json.
Json body_json(const GearBody& body);

/// The rims of all load cases with their means over the mesh cycle, line by line; empty without a gear on a web.
std::string rim_table(const StudyResults& results, std::size_t width);

/// Adds to a loaded result how the rims of gears on webs move at every position, "rims", and their means and largest to its summary, "rims". Only where
/// results.structures.rim_motion is not null.
void add_rim_motion(const LoadedResult& loaded, const StudyResults& results, Json& json);

}  // namespace flankwright::studies
