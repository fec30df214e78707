#pragma once

#include "studies/command_line/commands.hpp"

namespace flankwright::studies {

/// Runs every study of a folder, one after the other, each with results in a folder of its own below options.folder (default: results). Prints a
/// table with a line a study, and writes it as studies.csv there. A study that is wrong does not keep the others from running.
/// @param options  study: the folder
/// @return exit code: 2 where a study is wrong, else 1 where a requirement was not met
int run_folder(const RunOptions& options);

}  // namespace flankwright::studies
