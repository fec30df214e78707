#pragma once

#include "studies/json_format.hpp"
#include "studies/run_study.hpp"

namespace flankwright::studies {

/// A gear's shaft as used; false where it has none.
Json shaft_json(const std::optional<ShaftData>& shaft);

/// How the shafts move at every position of a loaded cycle; null without shafts.
Json shaft_motion_json(const LoadedResult& loaded, const StudyResults& results);

}  // namespace flankwright::studies
