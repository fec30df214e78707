#pragma once

#include <string>
#include <vector>

#include "studies/base/json_format.hpp"
#include "studies/results/tables.hpp"

namespace flankwright::studies {

/// The tables of the report that csv_tables() does not have, out of results.json: gears.csv (macro-geometry of both gears and the
/// pair), summary.csv and harmonics.csv (a line a load case), design.csv (variables and constraints before and after), effects.csv,
/// given.csv and used.csv (the study as written and with its defaults, a key and a value a line). A table without lines is left out.
///
/// @param results  results_document()
std::vector<NamedText> report_tables(const Json& results);

}  // namespace flankwright::studies
