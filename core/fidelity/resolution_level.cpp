#include "core/fidelity/resolution_level.hpp"

#include <algorithm>

namespace flankwright {

PerFigure ResolutionLevel::error() const {
  PerFigure both{};
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = quadrature_error[i] + position_error[i];
  return both;
}

PerFigure error_shares(const CycleErrors& errors, const CycleFigures& figures) {
  CycleFigures moved = figures;
  moved[Figure::TeMean] += errors.te_mean;
  moved[Figure::TePeakToPeak] += errors.te_peak_to_peak;
  for (std::size_t k = 0; k < std::min<std::size_t>(figure_harmonics, errors.te_harmonics.size()); ++k) {
    moved.value[static_cast<std::size_t>(Figure::TeHarmonic1) + k] += errors.te_harmonics[k];
  }
  moved[Figure::PeakContactStress] += errors.peak_contact_stress;
  moved[Figure::PeakLineLoad] += errors.peak_line_load;
  moved[Figure::LoadFactor] += errors.load_factor;
  return figure_errors(moved, figures);
}

}  // namespace flankwright
