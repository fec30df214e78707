#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flankwright::studies {

/// Studies named directly and all *.toml of named folders, in order of their names.
/// @throws InvalidInput where a folder cannot be read
std::vector<std::filesystem::path> collect_studies(const std::vector<std::string>& paths);

}  // namespace flankwright::studies
