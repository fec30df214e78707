#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "studies/comparison/compared_values.hpp"

namespace flankwright::studies {

/// "1 %" or "1%" as a share: 0.01. @throws InvalidInput "--tolerance" for anything else, and below 0
double parse_tolerance(std::string_view text);

/// The keys that differ and the headline quantities of all runs, with their changes from the first one, as a table.
std::string comparison_table(const std::vector<ComparedRun>& runs, const ComparedRuns& compared);

/// All of it: section, quantity and unit, the values of the runs, and for every run but the first the difference and the change in per cent of
/// the scale.
std::string comparison_csv(const std::vector<ComparedRun>& runs, const ComparedRuns& compared);

/// What differs from the first run by more than a tolerance, a line each; empty where nothing does.
std::vector<std::string> differing_lines(const std::vector<ComparedRun>& runs, const ComparedRuns& compared, double tolerance);

}  // namespace flankwright::studies
