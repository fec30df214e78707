#pragma once

#include <functional>
#include <vector>

#include "core/base/progress_report.hpp"
#include "core/rating/peak_gradient.hpp"

namespace flankwright::studies {

/// Refined peaks of one load case, and what load distribution factors compare them with.
struct LoadRating {
  Quadrature quadrature{};  ///< of the lines
  SpikeRule spikes;
  ContactPeaks perfect, lead, profile, combined;  ///< of the parts of the condition, see load_factors.hpp
  LoadFactors factors;
  PeakGradients peak_gradients, perfect_gradients;  ///< of the whole condition and of the perfect part
  LoadFactorGradients factor_gradients;             ///< empty rows where no derivatives were asked for
};

/// The mesh for a condition, see MeshPlacement, with what derivatives by these parameters need, see with_perturbed_meshes().
/// @param shafts_deflect  false: they are rigid
using MeshFor = std::function<MeshAt(const FlankCondition& condition, bool shafts_deflect, const std::vector<MeshParameter>& parameters)>;

/// A load case, and how its mesh is made.
struct RatedCase {
  MeshFor mesh_for;
  FlankCondition condition;
  double pinion_torque{not_given};  ///< [N mm]
  double rim_opening{0.0};          ///< under it, rim_opening() [mm]; 0: no gear is on a web
};

/// Rates load cases of one pair. Peaks of a condition are sought once, on all threads: the perfect pair's serve every scene at the same torque.
///
/// @param has_shafts  the pair has shafts that deflect; else meshes with and without them are the same
/// @param parameters  derivatives are given with respect to these
std::vector<LoadRating> rate_cases(const std::vector<RatedCase>& cases, bool has_shafts, const PeakSearch& search,
                                   const std::vector<MeshParameter>& parameters, const ProgressReport& progress = {});

}  // namespace flankwright::studies
