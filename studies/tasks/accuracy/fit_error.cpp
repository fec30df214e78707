#include "studies/tasks/accuracy/fit_error.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"

namespace flankwright::studies {

PerFigure fit_error(const CycleFigures& fitted, bool near_standard) {
  constexpr double of_mean = 0.0015, of_stress = 0.004, of_line_load = 0.02, of_peak_to_peak = 0.005, of_harmonics = 0.004;  // shares
  const double of_deflection = near_standard ? 0.00003 : 0.0003;  // a
  const double quiet = of_deflection * fitted.mean_approach / std::max(fitted[Figure::TePeakToPeak], quiet_share * fitted.mean_approach);
  PerFigure error;
  error.fill(of_harmonics + quiet);
  const auto of = [&](Figure f) -> double& { return error[static_cast<std::size_t>(f)]; };
  of(Figure::TeMean) = of_mean;
  of(Figure::TePeakToPeak) = of_peak_to_peak + quiet;
  of(Figure::PeakContactStress) = of_stress;
  of(Figure::PeakLineLoad) = of(Figure::LoadFactor) = of_line_load;
  return error;
}

bool near_standard(const GearPair& pair, const GearStructures& fitted) {
  constexpr double modules = 0.05, angle = 0.5 * units::deg, standard_angle = 20.0 * units::deg;
  bool near = std::abs(pair.data.pressure_angle - standard_angle) <= angle;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const RackProfile &rack = pair[member].data.rack, standard{};
    near = near && std::abs(rack.addendum - standard.addendum) <= modules && std::abs(rack.dedendum - standard.dedendum) <= modules &&
           std::abs(rack.root_radius - standard.root_radius) <= modules;
    const auto& refinement = fitted.refinement(member);
    near = near && refinement && refinement->unknown.empty();
  }
  return near;
}

}  // namespace flankwright::studies
