#pragma once

#include <cstdio>
#include <string>

#include "tests/benchmarks/contact_truth/contact_run.hpp"

namespace flankwright::contact_truth {

/// Runs the cases of a benchmark that the command line asks for: FOLDER [MESH] [PART_OF_A_CASE'S_NAME].
/// @param arguments  what the benchmark takes beyond these, for the line that says how it is called
/// @param run        called with the case and its own folder
/// @return           the exit code: 2 where the folder is missing, 1 without CalculiX
template <class Cases, class Run>
int run_cases(int argc, char** argv, const char* arguments, const Cases& cases, Run&& run) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s FOLDER [MESH] [PART_OF_A_CASE'S_NAME]%s\n", argv[0], arguments);
    return 2;
  }
  if (!calculix_is_installed()) {
    std::fprintf(stderr, "CalculiX (ccx, Debian package calculix-ccx) is not installed\n");
    return 1;
  }
  int number = 0;
  for (const auto& c : cases) {
    ++number;
    if (argc <= 3 || c.name.find(argv[3]) != c.name.npos) run(c, std::string(argv[1]) + "/" + std::to_string(number));
  }
  return 0;
}

}  // namespace flankwright::contact_truth
