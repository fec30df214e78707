#pragma once

#include <string>
#include <vector>

#include "studies/analysis/study_results.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/results/known_to.hpp"

namespace flankwright::studies {

/// CSV tables of a study (comma separated, decimal point, a header line with units): cycle.csv, points.csv, load_factors.csv and
/// load_sharing.csv of loaded contact; unloaded.csv, transfers.csv and bearing_pattern.csv of tooth contact analysis; then the task's own.
std::vector<NamedText> csv_tables(const StudyResults& results);

/// The output of a finished run: the choice for an accuracy, then the summary of the task.
std::string summary_table(const StudyResults& results);

/// Load cases line by line: figures with their errors, load factors, unloaded contact.
std::string analysis_table(const StudyResults& results);

/// Width of a column of names [characters].
std::size_t widest(const std::vector<std::string>& names, std::size_t least);

}  // namespace flankwright::studies
