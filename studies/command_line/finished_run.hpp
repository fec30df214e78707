#pragma once

#include <filesystem>
#include <string>

#include "studies/analysis/study_results.hpp"
#include "studies/base/json_format.hpp"
#include "studies/base/progress.hpp"

namespace flankwright::studies {

/// A study that has done its task.
struct FinishedRun {
  StudyResults results;
  Json document;          ///< of results.json
  std::string different;  ///< from [expect], a line each; empty: all is as expected

  /// Whether nothing that was required is missing: exit code 0 of a run.
  bool met() const { return results.requirements.empty() && different.empty(); }
};

/// Does the study's task.
/// @param folder  for the store of a sweep, which exists; empty: nothing is kept
/// @throws InvalidInput where the study cannot be analysed after all, or the store cannot be used
FinishedRun finish_study(const Study& study, const std::filesystem::path& folder, const ProgressReport& progress);

/// What is left of a task after its run_in_folder().
FinishedRun finished(StudyResults results);

/// Writes results.json, report.html and all tables, and of an optimisation results.sqlite, each whole or not at all.
/// @throws InvalidInput "output folder" where the folder cannot be written
void write_files(const FinishedRun& run, const std::filesystem::path& folder);

/// Leaves a run to the end of the process: the values of a large one are millions, and freeing them one by one takes a twentieth of the run's time.
void keep_until_exit(FinishedRun run);

}  // namespace flankwright::studies
