#pragma once

#include "studies/tasks/optimise/assessment.hpp"
#include "studies/base/results_folder.hpp"

namespace flankwright::studies {

/// CSV tables of an assessment: comparison.csv, sensitivity.csv and validation.csv, those that the study asks for.
std::vector<NamedText> assessment_tables(const Assessment& assessment);

/// Summary on the terminal: the best rule and the best variants beside the optimum, and what governs it.
std::string assessment_summary(const Assessment& assessment, const DesignTask& task, double optimum);

}  // namespace flankwright::studies
