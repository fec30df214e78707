#pragma once

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// The section `used` of results.json: the values used by the run, with defaults and derived values.
Json used_json(const StudyResults& results);

/// A quadrature as settings name it: rule and intervals.
Json quadrature_json(const Quadrature& quadrature);

}  // namespace flankwright::studies
