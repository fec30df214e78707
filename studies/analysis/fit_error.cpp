#include "studies/analysis/fit_error.hpp"

#include <algorithm>

namespace flankwright::studies {

PerFigure fit_error(const CycleFigures& fitted) {
  constexpr double of_mean = 0.0025, of_stress = 0.004, of_line_load = 0.02, of_peak_to_peak = 0.004, of_harmonics = 0.002;  // shares
  constexpr double peak_to_peak_of_deflection = 0.0012, harmonics_of_deflection = 0.0011;
  const double deflection = fitted.mean_approach / std::max(fitted[Figure::TePeakToPeak], quiet_share * fitted.mean_approach);  // Df/V
  PerFigure error;
  error.fill(of_harmonics + harmonics_of_deflection * deflection);
  const auto of = [&](Figure f) -> double& { return error[static_cast<std::size_t>(f)]; };
  of(Figure::TeMean) = of_mean;
  of(Figure::TePeakToPeak) = of_peak_to_peak + peak_to_peak_of_deflection * deflection;
  of(Figure::PeakContactStress) = of_stress;
  of(Figure::PeakLineLoad) = of(Figure::LoadFactor) = of_line_load;
  return error;
}

}  // namespace flankwright::studies
