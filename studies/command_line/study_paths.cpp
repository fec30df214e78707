#include "studies/command_line/study_paths.hpp"

#include <algorithm>
#include <system_error>

#include "core/base/error.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

std::vector<fs::path> collect_studies(const std::vector<std::string>& paths) {
  std::vector<fs::path> studies;
  for (const std::string& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      studies.emplace_back(path);
      continue;
    }
    std::vector<fs::path> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
      if (entry.path().extension() == ".toml") inside.push_back(entry.path());
    }
    if (error) throw InvalidInput("folder", path, "a folder that can be read (" + error.message() + ")");
    std::sort(inside.begin(), inside.end());
    studies.insert(studies.end(), inside.begin(), inside.end());
  }
  return studies;
}

}  // namespace flankwright::studies
