#pragma once

#include "studies/json_format.hpp"
#include "studies/run_study.hpp"

namespace flankwright::studies {

/// loaded[].gradients: derivatives of a loaded result by Study::gradients, lists with an entry per parameter, in the units of the
/// output's key per unit of the parameter.
Json gradients_json(const LoadedResult& loaded, const MeshModel& model, const Study& study);

}  // namespace flankwright::studies
