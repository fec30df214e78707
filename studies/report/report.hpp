#pragma once

#include <string>

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// The report of a study: one HTML page that opens without a network, made from its results alone.
///
/// Sections appear for what the results contain; a missing section or a null number is never an error. All text of
/// the results is shown as text: a title that looks like markup or script stays a title.
///
/// @param results  results_document(): a JSON object
/// @return the page, UTF-8
/// @throws InvalidInput where it is not an object
std::string render_report(const Json& results);

}  // namespace flankwright::studies
