#pragma once

#include <string>

namespace flankwright::studies {

/// A commented study file to start from, which parse_study() accepts as it is.
///
/// @param kind  the name of a task; "slurm": a script that runs a sweep in parts
/// @throws InvalidInput for another kind
std::string study_template(const std::string& kind);

}  // namespace flankwright::studies
