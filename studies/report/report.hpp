#pragma once

#include <string>

namespace flankwright::studies {

/// The report of a study: one HTML page that opens without a network, made from its results alone.
///
/// Sections appear for what the results contain; a missing section or a null number is never an error. All text of
/// the results is shown as text: a title that looks like markup or script stays a title.
///
/// @param results_json  text of results.json: a JSON object, UTF-8
/// @return the page, UTF-8
/// @throws InvalidInput where the text is not a JSON object
std::string render_report(const std::string& results_json);

}  // namespace flankwright::studies
