#pragma once

#include "studies/base/json_format.hpp"
#include "studies/tasks/optimise/assessment.hpp"

namespace flankwright::studies {

/// Values of the variables [mm; parabolic_te 1/rad] under their paths, in the units of their keys.
Json variables_json(const std::vector<double>& values, const DesignTask& task);

/// An entry of the tolerances that draws are made from: name, distribution, unit of its values, and whether they are added.
Json tolerance_json(const SceneTolerance& tolerance);

/// Adds `comparison`, `validation`, `governing` and `sensitivity` to the `optimise` part of the results.
void add_assessment(const Assessment& assessment, const DesignTask& task, const Study& study, Json& optimise);

}  // namespace flankwright::studies
