#include "studies/analysis/load_rating.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>

namespace flankwright::studies {

const ContactPeaks& LoadRater::peaks_of(const MeshFor& mesh_for, const FlankCondition& condition, double pinion_torque) {
  const auto found = std::ranges::find_if(known_, [&](const Known& k) { return k.torque == pinion_torque && k.condition == condition; });
  if (found != known_.end()) return found->peaks;
  known_.push_back({condition, pinion_torque, locate_peaks(mesh_for(condition, {}), condition, pinion_torque)});
  return known_.back().peaks;
}

void LoadRater::seek(const std::vector<Case>& cases) {
  std::vector<const Case*> of;  // of each that is to be sought
  const std::size_t first = known_.size();
  for (const Case& load_case : cases) {
    for (const ConditionPart part : {perfect_part, lead_part, profile_part, whole_condition}) {
      const FlankCondition condition = part(load_case.condition);
      const auto is_same = [&](const Known& k) { return k.torque == load_case.pinion_torque && k.condition == condition; };
      if (std::ranges::any_of(known_, is_same)) continue;
      known_.push_back({condition, load_case.pinion_torque, {}});
      of.push_back(&load_case);
    }
  }
  tbb::parallel_for(std::size_t{0}, of.size(), [&](std::size_t i) {
    Known& known = known_[first + i];
    known.peaks = locate_peaks(of[i]->mesh_for(known.condition, {}), known.condition, known.torque);
  });
}

LoadRating LoadRater::rate(const MeshFor& mesh_for, const FlankCondition& condition, double pinion_torque,
                           const std::vector<MeshParameter>& parameters) {
  LoadRating rating;
  rating.perfect = peaks_of(mesh_for, perfect_part(condition), pinion_torque);
  rating.lead = peaks_of(mesh_for, lead_part(condition), pinion_torque);
  rating.profile = peaks_of(mesh_for, profile_part(condition), pinion_torque);
  rating.combined = peaks_of(mesh_for, condition, pinion_torque);
  rating.factors = load_factors(rating.perfect, rating.lead, rating.profile, rating.combined);
  if (parameters.empty()) return rating;
  const auto rated = [&](const ContactPeaks& peaks, ConditionPart part) {
    std::vector<MeshParameter> acting;
    std::ranges::copy_if(parameters, std::back_inserter(acting), [&](const MeshParameter& p) { return acts(p, part); });
    const MeshAt mesh = mesh_for(part(condition), acting);
    return RatedPeaks{peaks, peak_gradients_of_part(mesh, condition, part, pinion_torque, peaks, parameters)};
  };
  const RatedPeaks combined = rated(rating.combined, whole_condition);
  const RatedPeaks perfect = rated(rating.perfect, perfect_part);
  rating.peak_gradients = combined.gradients;
  rating.perfect_gradients = perfect.gradients;
  rating.factor_gradients = load_factor_gradients(perfect, rated(rating.lead, lead_part), rated(rating.profile, profile_part), combined);
  return rating;
}

}  // namespace flankwright::studies
