#pragma once

#include <vector>

#include "core/compliance/comparison/deflection_curves.hpp"
#include "studies/compliance/gear_structures.hpp"

namespace flankwright::studies {

/// Deflection curves of one gear of a pair that was analysed.
struct GearDeflections {
  Member member{Member::Pinion};
  int teeth{0};
  std::vector<DeflectionCurve> curves;  ///< of "finite elements" or "fitted", "plate" and "thin slices"
};

/// Curves of both gears by the compliance that the study's analysis used, over the loaded tooth and its neighbours, beside
/// those of a cantilever plate and of thin slices. Empty where the structures are none of single gears.
std::vector<GearDeflections> gear_deflections(const Study& study, const GearPair& pair,
                                              const GearStructures& structures);

}  // namespace flankwright::studies
