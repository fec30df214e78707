#pragma once

#include <vector>

#include "studies/exchange/rexs/rexs_reading.hpp"

namespace flankwright::studies::rexs {

/// The components that modify a flank, reliefs of the profile first, then of the lead, topographies last.
std::vector<const Component*> modifications_of(const Reading& reading, const Component& flank);

}  // namespace flankwright::studies::rexs
