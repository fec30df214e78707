#pragma once

#include "studies/tasks/fit/fit_gears.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// One entry of fit[] of results.json; results.md describes it.
Json fit_json(const GearFit& fit);

}  // namespace flankwright::studies
