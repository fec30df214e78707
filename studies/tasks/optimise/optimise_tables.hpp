#pragma once

#include <string>
#include <vector>

#include "studies/analysis/study_results.hpp"
#include "studies/base/results_folder.hpp"

namespace flankwright::studies {

/// scenes.csv, history.csv, pareto.csv where there is a front, and the tables of the assessment.
std::vector<NamedText> optimise_tables(const StudyResults& results);

/// Summary on the terminal: variables, objective and constraints before and after, and the work of the search.
std::string optimise_summary(const StudyResults& results);

}  // namespace flankwright::studies
