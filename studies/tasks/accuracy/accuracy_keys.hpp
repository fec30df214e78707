#pragma once

#include <vector>

#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

/// Keys of [accuracy].
std::vector<SchemaKey> accuracy_keys();

}  // namespace flankwright::studies
