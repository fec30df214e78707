#pragma once

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Whether the study asks for derivatives, and the task has one design that they are of.
bool has_gradients(const StudyResults& results);

/// loaded[].gradients: derivatives of a loaded result by Study::gradients. A tree like that of the result, with a list in place of each number: an
/// entry per parameter, in the unit of the output's key per unit of the parameter; null where there is no output.
/// @param loaded  usable
Json gradients_json(const LoadedResult& loaded, const StudyResults& results);

}  // namespace flankwright::studies
