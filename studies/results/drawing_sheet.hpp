#pragma once

#include <string>

#include "studies/results/drawn_flank.hpp"

namespace flankwright::studies {

/// The sheet of a flank: its K-charts and the lines beside them, a picture of its own. Each trace has a panel with its band; all panels of a chart have
/// the same scale, so that the twist of a flank can be seen across them.
std::string drawing_svg(const FlankDrawing& drawing);

}  // namespace flankwright::studies
