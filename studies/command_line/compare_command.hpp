#pragma once

#include <string>
#include <vector>

namespace flankwright::studies {

struct CompareCommand {
  std::vector<std::string> folders;  ///< at least two results folders
  std::string folder{"comparison"};  ///< for comparison.html and comparison.csv
  std::string tolerance;             ///< "1%"; empty: differences are shown and no matter
};

/// Compares runs: a table on stdout, comparison.html and comparison.csv in a folder.
/// @return exit code: 1 where a tolerance is given and something differs from the first run by more; it is listed
int compare_command(const CompareCommand& options);

}  // namespace flankwright::studies
