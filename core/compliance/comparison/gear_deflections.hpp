#pragma once

#include <string>
#include <vector>

#include "core/base/for_each_index.hpp"
#include "core/compliance/comparison/deflection_curves.hpp"
#include "core/compliance/pair/pair_compliance.hpp"

namespace flankwright {

/// Deflection curves of one gear of a pair that was analysed.
struct GearDeflections {
  Member member{Member::Pinion};
  int teeth{0};
  std::vector<DeflectionCurve> curves;  ///< of the pair's own model, "plate" and "thin slices"
};

/// Curves of both gears by their structure, over the loaded tooth and its neighbours, beside those of a cantilever plate and of
/// thin slices.
/// @param structure  of the pair; the result is empty where it is none of single gears, or null
/// @param name       of its model in the curves
/// @param for_each   goes through both gears; nothing: one after the other
std::vector<GearDeflections> gear_deflections(const GearPair& pair, const Material& pinion, const Material& wheel, const PairCompliance* structure,
                                              const std::string& name, const ForEachIndex& for_each = {});

}  // namespace flankwright
