#pragma once

#include <string>
#include <vector>

#include "studies/base/results_folder.hpp"
#include "studies/tasks/study_results.hpp"

namespace flankwright::studies {

/// CSV tables of a study (comma separated, decimal point, a header line with units): cycle.csv and points.csv for loaded contact,
/// unloaded.csv, transfers.csv and bearing_pattern.csv for tooth contact analysis, scenes.csv and history.csv for an optimisation;
/// for fits see fit_tables(), for sweeps sweep_tables().
std::vector<NamedText> csv_tables(const StudyResults& results);

/// What a run prints when it is done: before and after for an optimisation, residuals for fits, one line an output for a sweep, one line a scene otherwise.
std::string summary_table(const StudyResults& results);

}  // namespace flankwright::studies
