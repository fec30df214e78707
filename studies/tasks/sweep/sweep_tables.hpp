#pragma once

#include <filesystem>
#include <string>

#include "studies/analysis/study_results.hpp"
#include "studies/tasks/sweep/sweep_store.hpp"
#include "studies/base/results_folder.hpp"

namespace flankwright::studies {

/// Where the worst sample of an output lies below the results folder: "worst/peak_contact_stress_MPa.toml".
std::string worst_study_name(const SweepOutput& output);

/// sweep_statistics.csv and sweep_indices.csv; none without a sweep.
std::vector<NamedText> sweep_tables(const StudyResults& results);

/// Summary on the terminal: a line for each output.
std::string sweep_summary(const StudyResults& results);

/// Writes samples.csv (all samples, line by line, so that memory does not grow with them) and the studies of the worst samples.
void write_sweep_files(const StudyResults& results, const std::filesystem::path& folder, SweepStore& store);

}  // namespace flankwright::studies
