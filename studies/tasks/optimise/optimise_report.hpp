#pragma once

#include <vector>

#include "studies/results/report_section.hpp"

namespace flankwright::studies {

/// The sections of an optimisation: the modifications to grind and their gain, how certain it is, how it was found.
std::vector<ReportSection> optimise_sections();

}  // namespace flankwright::studies
