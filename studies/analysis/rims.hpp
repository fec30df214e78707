#pragma once

#include "core/rating/shaft_misalignment.hpp"
#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// The rims on the flanks that a mesh has touching; null: no gear is on a web.
inline const PairRimMotion* rims_of(const StudyResults& results, const MeshModel& model) {
  const bool behind = model.placement.other_flanks && results.structures.other_flanks;
  return (behind ? *results.structures.other_flanks : results.structures).rim_motion.get();
}

/// rim_opening() under a torque [mm]; 0 where no gear is on a web.
inline double rim_opening(const StudyResults& results, const MeshModel& model, double pinion_torque) {
  const PairRimMotion* rims = rims_of(results, model);
  return rims != nullptr ? rim_opening(*rims, model, model.normal_force(pinion_torque)) : 0.0;
}

}  // namespace flankwright::studies
