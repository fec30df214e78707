#pragma once

#include "studies/json_format.hpp"
#include "studies/run_study.hpp"

namespace flankwright::studies {

/// The part `optimise` of results.json; needs design and design_task.
Json optimise_json(const StudyResults& results);

}  // namespace flankwright::studies
