#pragma once

#include "core/fidelity/resolved_cycle.hpp"

namespace flankwright {

/// The figures of a resolution, and their errors.
struct ResolutionLevel {
  int intervals{0}, positions{0};
  CycleFigures figures;                            ///< with extremes between the positions where they were sought
  PerFigure quadrature_error{}, position_error{};  ///< estimated shares, as figure_errors() counts them
  PerFigure error() const;                         ///< their sum
};

/// Estimated errors as shares, as figure_errors() counts them; NaN where none was estimated.
PerFigure error_shares(const CycleErrors& errors, const CycleFigures& figures);

}  // namespace flankwright
