#include "studies/results/load_rating_json.hpp"

#include <cmath>

#include "core/rating/load_sharing.hpp"

namespace flankwright::studies {

namespace {

Json place_json(const LinePeak& peak) { return {{"phase", peak.phase}, {"tooth", peak.tooth}, {"z_mm", peak.z}}; }

Json pair_json(const ContactPeaks::Pair& peaks) {
  return {{"contact_stress_MPa", peaks.contact_stress.value},
          {"contact_stress_at", place_json(peaks.contact_stress)},
          {"load_N_per_mm", peaks.line_load.value},
          {"load_at", place_json(peaks.line_load)}};
}

Json triple_json(const LoadFactors::Triple& factors) {
  return {{"K_Hbeta", factors.lead}, {"K_Halpha", factors.profile}, {"K_H", factors.combined}, {"K_Hbeta_times_K_Halpha", factors.product()}};
}

}  // namespace

Json peaks_json(const LoadRating& rating, const MeshModel& model) {
  return {{"without_spikes", pair_json(rating.combined.without_spikes)},
          {"with_spikes", pair_json(rating.combined.with_spikes)},
          {"perfect_pair", {{"without_spikes", pair_json(rating.perfect.without_spikes)}, {"with_spikes", pair_json(rating.perfect.with_spikes)}}},
          {"spike_rule", {{"line_share", rating.spikes.line_share}, {"end_distance_mm", rating.spikes.end_distance * model.pair.data.normal_module}}},
          {"intervals", rating.quadrature.intervals},
          {"positions", rating.combined.positions},
          {"phase_tolerance", rating.combined.phase_tolerance}};
}

Json load_factors_json(const LoadRating& rating) {
  return {{"without_spikes", triple_json(rating.factors.without_spikes)},
          {"with_spikes", triple_json(rating.factors.with_spikes)},
          {"line_load", triple_json(rating.factors.line_load)}};
}

Json iso_json(const IsoStiffness& stiffness, const IsoLoadFactors& factors) {
  return {{"c_prime", stiffness.c_prime},
          {"c_gamma", stiffness.c_gamma},
          {"within_range", stiffness.within_range && stiffness.mean_within_range},
          {"K_Hbeta", factors.lead},
          {"K_Halpha", factors.profile},
          {"K_H", factors.combined()},
          {"K_Halpha_limit", factors.profile_limit},
          {"F_beta_y_um", in_um(factors.deviations.misalignment)},
          {"f_pe_um", in_um(factors.deviations.base_pitch)},
          {"y_alpha_um", in_um(factors.running_in)},
          {"specific_load_N_per_mm", factors.specific_load}};
}

Json te_convergence_json(const LoadedCycle& cycle) {
  const Eigen::VectorXd error = cycle.transmission_error();
  const CycleConvergence convergence = cycle_convergence({error.begin(), error.end()});
  if (std::isnan(convergence.harmonic_change)) return nullptr;
  return {{"positions", convergence.positions},
          {"harmonic_change_um", in_um(convergence.harmonic_change)},
          {"peak_to_peak_change_um", in_um(convergence.peak_to_peak_change)}};
}

std::map<int, Json> line_ends_json(const std::vector<LineEnd>& ends) {
  std::map<int, Json> teeth;
  for (const LineEnd& end : ends) {
    Json& of_tooth = teeth.try_emplace(end.tooth, Json::array()).first->second;
    of_tooth.push_back({{"z_mm", end.z}, {"load_N_per_mm", end.line_load}, {"contact_stress_MPa", end.contact_stress}});
  }
  return teeth;
}

std::map<int, double> shares_by_tooth(const MeshPosition& at, const LoadedPosition& position) {
  std::map<int, double> shares;
  for (const ToothShare& tooth : load_sharing(at, position)) shares[tooth.tooth] = tooth.share;
  return shares;
}

}  // namespace flankwright::studies
