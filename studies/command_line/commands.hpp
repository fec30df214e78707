#pragma once

#include <string>
#include <vector>

#include "studies/study_file/study_file.hpp"

/// The commands of the command line; each returns the exit code: 0 done, 1 a requirement not met, 2 bad input (thrown as
/// InvalidInput), 3 internal error.
namespace flankwright::studies {

struct RunOptions {
  std::string study;
  std::string folder;               ///< empty: results/ + the study file's name
  std::vector<Override> overrides;  ///< --set
  std::string shard{};              ///< "3/100": of a sweep this part of the samples alone; empty: all
};

/// Does the study's task, prints the summary on stdout and writes results.json, report.html and CSV tables, and for an
/// optimisation results.sqlite.
int run_command(const RunOptions& options);

/// Puts the shards of a sweep together and does the rest of run_command().
int merge_command(const RunOptions& options);

/// Reads and validates only.
int check_command(const std::string& study, const std::vector<Override>& overrides);

/// Prints a commented study file.
int new_command(const std::string& kind);

/// Rebuilds report.html from the results.json of a folder.
int report_command(const std::string& folder);

/// Runs every study of the given files and folders that has an [expect] table; a line each.
/// @param accept  write today's values into a copy of each study, FILE.accepted
int test_command(const std::vector<std::string>& paths, bool accept);

}  // namespace flankwright::studies
