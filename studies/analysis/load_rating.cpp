#include "studies/analysis/load_rating.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "studies/analysis/step_progress.hpp"

namespace flankwright::studies {

namespace {

constexpr std::array rated_parts{perfect_part, lead_part, profile_part, whole_condition};

/// Peaks of one condition.
struct Sought {
  const RatedCase* of;  ///< the first load case that has it
  FlankCondition condition;
  bool shafts_deflect;
  ContactPeaks peaks;
};

FlankCondition condition_of(const RatedCase& of, ConditionPart part) { return part_without_rims(of.condition, part, of.rim_opening); }

void add_gradients(const RatedCase& load_case, bool has_shafts, const std::vector<MeshParameter>& parameters, LoadRating& rating) {
  const double torque = load_case.pinion_torque, opening_per_torque = load_case.rim_opening / torque;
  const auto rated = [&](const ContactPeaks& peaks, ConditionPart part) {
    std::vector<MeshParameter> acting;
    std::ranges::copy_if(parameters, std::back_inserter(acting), [&](const MeshParameter& p) { return acts(p, part); });
    if (opening_per_torque != 0.0) acting.push_back(&Misalignment::mesh_misalignment);  // changes with the torque
    const MeshAt mesh = load_case.mesh_for(condition_of(load_case, part), has_shafts && shafts_deflect(part), acting);
    return RatedPeaks{peaks, peak_gradients_of_part(mesh, load_case.condition, part, torque, peaks, parameters, opening_per_torque)};
  };
  const RatedPeaks combined = rated(rating.combined, whole_condition);
  const RatedPeaks perfect = rated(rating.perfect, perfect_part);
  rating.peak_gradients = combined.gradients;
  rating.perfect_gradients = perfect.gradients;
  rating.factor_gradients = load_factor_gradients(perfect, rated(rating.lead, lead_part), rated(rating.profile, profile_part), combined);
}

}  // namespace

std::vector<LoadRating> rate_cases(const std::vector<RatedCase>& cases, bool has_shafts, const PeakSearch& search,
                                   const std::vector<MeshParameter>& parameters, const ProgressReport& progress) {
  std::vector<Sought> sought;
  std::vector<std::array<std::size_t, rated_parts.size()>> places(cases.size());  // of the parts of each load case, in `sought`
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (std::size_t p = 0; p < rated_parts.size(); ++p) {
      const FlankCondition condition = condition_of(cases[i], rated_parts[p]);
      const bool deflect = has_shafts && shafts_deflect(rated_parts[p]);
      const auto known = std::ranges::find_if(sought, [&](const Sought& s) {
        return s.of->pinion_torque == cases[i].pinion_torque && s.shafts_deflect == deflect && s.condition == condition;
      });
      places[i][p] = static_cast<std::size_t>(known - sought.begin());
      if (known == sought.end()) sought.push_back({&cases[i], condition, deflect, {}});
    }
  }
  StepProgress step(progress, "seeking peaks for load factors", sought.size());
  tbb::parallel_for(std::size_t{0}, sought.size(), [&](std::size_t i) {
    Sought& s = sought[i];
    s.peaks = locate_peaks(s.of->mesh_for(s.condition, s.shafts_deflect, {}), s.condition, s.of->pinion_torque, search);
    step.add_one();
  });
  std::vector<LoadRating> ratings(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto peaks = [&](std::size_t part) { return sought[places[i][part]].peaks; };
    LoadRating& rating = ratings[i];
    rating.perfect = peaks(0);
    rating.lead = peaks(1);
    rating.profile = peaks(2);
    rating.combined = peaks(3);
    rating.factors = load_factors(rating.perfect, rating.lead, rating.profile, rating.combined);
    if (!parameters.empty()) add_gradients(cases[i], has_shafts, parameters, rating);
  }
  return ratings;
}

}  // namespace flankwright::studies
