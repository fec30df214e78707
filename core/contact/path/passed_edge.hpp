#pragma once

#include <algorithm>
#include <cmath>

namespace flankwright {

/// The clearance at an edge that a contact has passed: two parabolas of relative radius R would touch a distance e beyond the edge. A sharp edge keeps
/// them c = e^2/(2 R) apart, an edge of radius rho e^2/(2 (R + rho)), so that its rounding fills c rho/(R + rho). All in mm.
struct PassedEdge {
  double sharp{0.0};        ///< clearance of the sharp edge
  double rounded_off{0.0};  ///< part of it that the rounding fills
  double rounded() const { return sharp - rounded_off; }

  static PassedEdge at(double beyond, double relative_radius, double rounding) {
    const double sharp = 0.5 * beyond * beyond / relative_radius;
    return {sharp, sharp * rounding / (relative_radius + rounding)};
  }
  /// e of a sharp edge's clearance, >= 0.
  static double beyond(double sharp, double relative_radius) { return std::sqrt(2.0 * relative_radius * std::max(0.0, sharp)); }
};

}  // namespace flankwright
