#pragma once

#include <optional>
#include <vector>

#include "core/base/error.hpp"
#include "core/gear/pair_geometry.hpp"

namespace flankwright {

/// Everything in the data that cannot be built, all at once; empty where make_gear_pair() will succeed. Fields carry the
/// names of the study file ("pinion.teeth", "pair.centre_distance"). Where a pair could be built but for its tooth thickness allowances, it is
/// these that are named, with the range that they may have.
std::vector<InvalidInput> find_problems(const PairData& data);

/// Whether a chamfer leaves part of the tip, and turns from the flank towards it; one condition of find_problems(), for data that are not whole yet.
bool has_room_for_tip_chamfer(Member m, const PairData& pair);

/// Radius of the edges of a gear of which nothing is known, see edges.hpp; 0 for data that are not whole yet.
double usual_edge_radius(Member m, const PairData& pair);

/// Radius of the edge, of the tip rounding or below the chamfer that the gear has, with which its flank ends at a circle [mm], > 0; for data that are not
/// whole yet. Nothing where the circle is not between the base circle and the sharp end of the flank, or a rounding would leave no tip.
std::optional<double> edge_radius_for(Member m, const PairData& pair, double tip_form_radius);

/// Builds the pair. Throws the first of find_problems().
GearPair make_gear_pair(const PairData& data);

}  // namespace flankwright
