#pragma once

#include <vector>

#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

/// Keys of [sweep].
std::vector<SchemaKey> sweep_keys();

}  // namespace flankwright::studies
