#include "core/compliance/fitted/correction_fit.hpp"

#include "core/compliance/tooth/station_grid.hpp"

namespace flankwright {

GearMeshOptions coarse_mesh() {
  GearMeshOptions options;
  options.flank_elements = 3;
  options.adjacent_flank_elements = 2;
  options.adjacent_fillet_elements = 2;
  options.end_element = 0.3;
  options.axial_growth = 1.5;
  options.largest_element = AxialSteps{}.largest;
  return options;
}

GearToMesh standard_gear(const GearProportions& gear_proportions, const ReferenceProfile& profile) {
  GearToMesh gear;
  gear.gear.teeth = gear_proportions.teeth;
  gear.gear.face_width = gear_proportions.relative_face;
  gear.gear.profile_shift = gear_proportions.profile_shift;
  gear.normal_module = 1;
  gear.gear.rack = profile.rack;
  gear.pressure_angle = profile.pressure_angle;
  gear.helix_angle = gear_proportions.helix_angle;
  return gear;
}

std::vector<FlankStation> places_on(const std::vector<double>& us, const std::vector<double>& zetas) {
  std::vector<FlankStation> stations;
  for (const double u : us) {
    for (const double zeta : zetas) stations.push_back({0, u, zeta});
  }
  return stations;
}

CorrectionSamples correction_samples(const GearProportions& gear, const FlankCompliance& fine, const FlankCompliance& coarse) {
  // Fewer than station_grid() has: kernels are smooth, and what they add changes fastest next to the ends.
  const std::vector<double> zetas = axial_stations(gear.relative_face, {.first = 0.15, .growth = 0.28, .largest = 1.15});
  std::vector<double> midways;
  for (std::size_t i = 1; i < zetas.size(); ++i) midways.push_back(0.5 * (zetas[i - 1] + zetas[i]));
  const auto sample = [&](const std::vector<double>& us, const std::vector<double>& at) {
    const std::vector<FlankStation> stations = places_on(us, at);
    return InfluenceSample{gear, stations, fine.evaluate(stations), coarse.evaluate(stations)};
  };
  return {sample({-1, -0.6, -0.2, 0.2, 0.6, 1}, zetas), sample({-0.9, -0.45, 0.05, 0.5, 0.95}, midways)};
}

CorrectionEntry fit_correction(const CorrectionSamples& samples, const std::vector<double>& start) {
  FitOptions options;
  options.start = start;
  options.tooth_ridge = start.empty() ? 2.4e-4 : 1e-3;
  options.scale_floor = kScaleFloor;
  options.solver.max_iterations = 1000;  // the first, from a flat start, takes hundreds
  const FitResult result = fit_compliance({&samples.fitted, 1}, KernelForm::correction(), options);
  CorrectionEntry entry;
  entry.gear = samples.fitted.gear;
  entry.status = result.status;
  entry.iterations = result.iterations;
  entry.pairs = result.pairs;
  if (!result.fit) return entry;
  entry.coefficients = result.fit->coefficients();
  entry.covariance = result.covariance;
  entry.fitted = residual_statistics(*result.fit, {&samples.fitted, 1}, kScaleFloor).front();
  entry.unseen = residual_statistics(*result.fit, {&samples.unseen, 1}, kScaleFloor).front();
  return entry;
}

}  // namespace flankwright
