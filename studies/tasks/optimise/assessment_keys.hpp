#pragma once

#include <vector>

#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

/// Keys of [optimise] that say what an optimum is compared with.
std::vector<SchemaKey> assessment_keys();

}  // namespace flankwright::studies
