#pragma once

#include <vector>

#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

/// Keys of [optimise.scatter].
std::vector<SchemaKey> scatter_keys();

}  // namespace flankwright::studies
