#pragma once

#include "studies/compliance/fit_task.hpp"
#include "core/compliance/comparison/gear_deflections.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// One entry of fit[] of results.json; results.md describes it.
Json fit_json(const GearFit& fit);

/// One entry of deflections[] of results.json.
Json deflections_json(const GearDeflections& deflections);

}  // namespace flankwright::studies
