#pragma once

#include <vector>

#include "core/base/error.hpp"
#include "core/gear/pair_geometry.hpp"

namespace flankwright {

/// Errors of a gear's generating tool in itself: numbers out of range, a surface of revolution for a helical gear.
/// Fields as "pinion.generation.half_apex"; angles in deg.
std::vector<InvalidInput> find_tool_problems(const PairData& pair, Member member);

/// Why a valid tool cannot generate the flank: from the start of the active profile to the tip circle, over the whole
/// face and a little beyond (GeneratedRange::regular_margin), the envelope must have no cusp (undercut), lie on the
/// tool and grow in radius with rho. Names the limit: the largest coefficient, the least arc_radius, or the least
/// distance.
std::vector<InvalidInput> find_generation_problems(const Gear& gear, const PairData& pair);

/// The largest coefficient of a ParabolicRack [1/mm] that find_generation_problems() accepts, to round-off.
double largest_parabola_coefficient(const Gear& gear, const PairData& pair);

}  // namespace flankwright
