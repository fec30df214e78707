#pragma once

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// loaded[].gradients: derivatives of a loaded result by Study::gradients. A tree like that of the result, with a list in place of each number: an
/// entry per parameter, in the unit of the output's key per unit of the parameter; null where there is no output.
/// @param loaded  usable
Json gradients_json(const LoadedResult& loaded, const StudyResults& results);

}  // namespace flankwright::studies
