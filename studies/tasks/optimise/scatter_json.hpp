#pragma once

#include <string>
#include <vector>

#include "studies/analysis/study_results.hpp"
#include "studies/base/json_format.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/tasks/optimise/scatter.hpp"

namespace flankwright::studies {

/// optimise.scatter of results.json.
Json scatter_json(const ScatterResult& result, const DesignTask& task, const Study& study);

/// Tables: classes.csv, what each tolerance class costs, and scatter.csv, the fresh draws; those that were asked for.
std::vector<NamedText> scatter_tables(const ScatterResult& result, const DesignTask& task);

/// Lines for the terminal.
std::string scatter_summary(const ScatterResult& result, const DesignTask& task, const Study& study);

/// The statistic in words: "95 % quantile", "mean + 2 sigma", "mean of the worst 10 %".
std::string statistic_in_words(const Aggregation& statistic);
/// The statistic of an output that a constraint bounds: of a lower limit "the 5 % quantile", where that of an upper one is "the 95 % quantile".
std::string statistic_in_words(const Aggregation& statistic, const OutputConstraint& of);
/// The statistic by which choices of what to grind were judged; empty where they were judged by the listed scenes.
std::string statistic_of_choices(const StudyResults& results);

}  // namespace flankwright::studies
