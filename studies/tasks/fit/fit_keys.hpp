#pragma once

#include <vector>

#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

/// Keys of [fit].
std::vector<SchemaKey> fit_keys();

}  // namespace flankwright::studies
