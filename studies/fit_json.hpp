#pragma once

#include "studies/fit_task.hpp"
#include "studies/gear_deflections.hpp"
#include "studies/json_format.hpp"

namespace flankwright::studies {

/// One entry of fit[] of results.json; results.md describes it.
Json fit_json(const GearFit& fit);

/// One entry of deflections[] of results.json.
Json deflections_json(const GearDeflections& deflections);

}  // namespace flankwright::studies
