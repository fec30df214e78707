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

const ContactPeaks& LoadRater::peaks_of(const MeshFor& mesh_for, const FlankCondition& condition, ConditionPart part, double pinion_torque) {
  const FlankCondition of_part = part(condition);
  const bool shafts = with_shafts(part);
  if (const Known* known = find(of_part, pinion_torque, shafts)) return known->peaks;
  known_.push_back({of_part, pinion_torque, shafts, locate_peaks(mesh_for(of_part, shafts, {}), of_part, pinion_torque)});
  return known_.back().peaks;
}

void LoadRater::seek(const std::vector<Case>& cases) {
  std::vector<const Case*> of;  // of each that is to be sought
  const std::size_t first = known_.size();
  for (const Case& load_case : cases) {
    for (const ConditionPart part : {perfect_part, lead_part, profile_part, whole_condition}) {
      const FlankCondition condition = part(load_case.condition);
      if (find(condition, load_case.pinion_torque, with_shafts(part)) != nullptr) continue;
      known_.push_back({condition, load_case.pinion_torque, with_shafts(part), {}});
      of.push_back(&load_case);
    }
  }
  tbb::parallel_for(std::size_t{0}, of.size(), [&](std::size_t i) {
    Known& known = known_[first + i];
    known.peaks = locate_peaks(of[i]->mesh_for(known.condition, known.shafts_deflect, {}), known.condition, known.torque);
  });
}

LoadRating LoadRater::rate(const MeshFor& mesh_for, const FlankCondition& condition, double pinion_torque,
                           const std::vector<MeshParameter>& parameters) {
  LoadRating rating;
  const auto peaks = [&](ConditionPart part) { return peaks_of(mesh_for, condition, part, pinion_torque); };
  rating.perfect = peaks(perfect_part);
  rating.lead = peaks(lead_part);
  rating.profile = peaks(profile_part);
  rating.combined = peaks(whole_condition);
  rating.factors = load_factors(rating.perfect, rating.lead, rating.profile, rating.combined);
  if (parameters.empty()) return rating;
  const auto rated = [&](const ContactPeaks& peaks_of_part, ConditionPart part) {
    std::vector<MeshParameter> acting;
    std::ranges::copy_if(parameters, std::back_inserter(acting), [&](const MeshParameter& p) { return acts(p, part); });
    const MeshAt mesh = mesh_for(part(condition), with_shafts(part), acting);
    return RatedPeaks{peaks_of_part, peak_gradients_of_part(mesh, condition, part, pinion_torque, peaks_of_part, parameters)};
  };
  const RatedPeaks combined = rated(rating.combined, whole_condition);
  const RatedPeaks perfect = rated(rating.perfect, perfect_part);
  rating.peak_gradients = combined.gradients;
  rating.perfect_gradients = perfect.gradients;
  rating.factor_gradients = load_factor_gradients(perfect, rated(rating.lead, lead_part), rated(rating.profile, profile_part), combined);
  return rating;
}

}  // namespace flankwright::studies
