#pragma once

#include <string>

#include "studies/base/json_format.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// What results.json holds of a finished study. Units are in the key names; a number that was not computed is null.
/// results.md describes every section.
Json results_document(const StudyResults& results);

/// The document as the text of a file.
std::string json_text(const Json& document);

/// Text of results.json.
std::string results_json(const StudyResults& results);

}  // namespace flankwright::studies
