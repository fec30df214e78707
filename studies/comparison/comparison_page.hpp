#pragma once

#include <string>
#include <vector>

#include "studies/comparison/compared_values.hpp"

namespace flankwright::studies {

/// Several runs side by side as one HTML page that opens without a network: what differs between the studies, the headline quantities with their
/// changes, transmission error curves, and the maps of removal and contact stress of all runs on one colour scale. It uses the scripts of the report.
std::string comparison_page(const std::vector<ComparedRun>& runs, const ComparedRuns& compared);

}  // namespace flankwright::studies
