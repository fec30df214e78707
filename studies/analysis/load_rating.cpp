#include "studies/analysis/load_rating.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>

namespace flankwright::studies {

const LoadRater::Known* LoadRater::find(const FlankCondition& condition, double pinion_torque, bool shafts_deflect) const {
  const auto found = std::ranges::find_if(
      known_, [&](const Known& k) { return k.torque == pinion_torque && k.shafts_deflect == shafts_deflect && k.condition == condition; });
  return found == known_.end() ? nullptr : &*found;
}

const ContactPeaks& LoadRater::peaks_of(const Case& load_case, ConditionPart part) {
  const FlankCondition condition = condition_of(load_case, part);
  const bool shafts = with_shafts(part);
  if (const Known* known = find(condition, load_case.pinion_torque, shafts)) return known->peaks;
  const ContactPeaks peaks = locate_peaks(load_case.mesh_for(condition, shafts, {}), condition, load_case.pinion_torque, search);
  known_.push_back({condition, load_case.pinion_torque, shafts, peaks});
  return known_.back().peaks;
}

void LoadRater::seek(const std::vector<Case>& cases) {
  std::vector<const Case*> of;  // of each that is to be sought
  const std::size_t first = known_.size();
  for (const Case& load_case : cases) {
    for (const ConditionPart part : {perfect_part, lead_part, profile_part, whole_condition}) {
      const FlankCondition condition = condition_of(load_case, part);
      if (find(condition, load_case.pinion_torque, with_shafts(part)) != nullptr) continue;
      known_.push_back({condition, load_case.pinion_torque, with_shafts(part), {}});
      of.push_back(&load_case);
    }
  }
  tbb::parallel_for(std::size_t{0}, of.size(), [&](std::size_t i) {
    Known& known = known_[first + i];
    known.peaks = locate_peaks(of[i]->mesh_for(known.condition, known.shafts_deflect, {}), known.condition, known.torque, search);
  });
}

LoadRating LoadRater::rate(const Case& load_case, const std::vector<MeshParameter>& parameters) {
  LoadRating rating;
  rating.perfect = peaks_of(load_case, perfect_part);
  rating.lead = peaks_of(load_case, lead_part);
  rating.profile = peaks_of(load_case, profile_part);
  rating.combined = peaks_of(load_case, whole_condition);
  rating.factors = load_factors(rating.perfect, rating.lead, rating.profile, rating.combined);
  if (parameters.empty()) return rating;
  const double torque = load_case.pinion_torque, opening_per_torque = load_case.rim_opening / torque;
  const auto rated = [&](const ContactPeaks& peaks, ConditionPart part) {
    std::vector<MeshParameter> acting;
    std::ranges::copy_if(parameters, std::back_inserter(acting), [&](const MeshParameter& p) { return acts(p, part); });
    if (opening_per_torque != 0.0) acting.push_back(&Misalignment::mesh_misalignment);  // changes with the torque
    const MeshAt mesh = load_case.mesh_for(condition_of(load_case, part), with_shafts(part), acting);
    return RatedPeaks{peaks, peak_gradients_of_part(mesh, load_case.condition, part, torque, peaks, parameters, opening_per_torque)};
  };
  const RatedPeaks combined = rated(rating.combined, whole_condition);
  const RatedPeaks perfect = rated(rating.perfect, perfect_part);
  rating.peak_gradients = combined.gradients;
  rating.perfect_gradients = perfect.gradients;
  rating.factor_gradients = load_factor_gradients(perfect, rated(rating.lead, lead_part), rated(rating.profile, profile_part), combined);
  return rating;
}

}  // namespace flankwright::studies
