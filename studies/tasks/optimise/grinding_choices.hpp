#pragma once

#include <string>
#include <vector>

#include "optimize/design/design_optimiser.hpp"
#include "studies/base/json_format.hpp"
#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Reads optimise.grinding.not_together, and checks it and smallest_amount against the variables: one of their alternatives must be open. After the
/// variables and ties.
void read_grinding_choices(StudyReading& reading);

/// optimise.grinding_choices of results.json: every choice with its amounts, what was tried and what each gave.
/// @param statistic  of the objective over draws, by which they were judged: "95 % quantile"; empty: by the listed scenes
Json grinding_choices_json(const DesignResult& design, const DesignTask& task, const std::string& statistic);

/// A sentence for each choice: "pinion tip relief, 1.2 um, is below the smallest amount: 0 gives 431 MPa, at least 3 um gives 428 MPa (taken)"
std::vector<std::string> grinding_choices_in_words(const DesignResult& design, const DesignTask& task, const std::string& statistic);

}  // namespace flankwright::studies
