#pragma once

#include <vector>

#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

/// Keys of [optimise], without those of its assessment.
std::vector<SchemaKey> optimise_keys();

}  // namespace flankwright::studies
