#pragma once

#include <string>

namespace flankwright::studies {

/// A commented study file to start from, which parse_study() accepts as it is.
///
/// @param kind  "analyse" or "optimise"
/// @throws InvalidInput for another kind; "sweep", "accuracy" and "fit" are named as not in this version
std::string study_template(const std::string& kind);

}  // namespace flankwright::studies
