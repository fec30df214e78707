#pragma once

#include "studies/base/json_format.hpp"
#include "studies/tasks/optimise/assessment.hpp"

namespace flankwright::studies {

/// An entry of the tolerances that draws are made from: name, distribution, unit of its values, and whether they are added.
Json tolerance_json(const SceneTolerance& tolerance);

/// Adds `comparison`, `validation`, `governing` and `sensitivity` to the `optimise` part of the results.
void add_assessment(const Assessment& assessment, const DesignTask& task, const Study& study, Json& optimise);

}  // namespace flankwright::studies
