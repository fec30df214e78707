#pragma once

#include <algorithm>
#include <cmath>

namespace flankwright {

/// The clearance at an edge that a contact has passed: two parabolas of relative radius R would touch a distance e beyond the edge. A sharp edge keeps
/// them c = e^2/(2 R) apart, an edge of radius rho e^2/(2 (R + rho)), so that its rounding fills c rho/(R + rho). All in mm.
struct PassedEdge {
  double rounded{0.0};      ///< clearance of the edge with its rounding
  double rounded_off{0.0};  ///< part of the sharp edge's clearance that the rounding fills

  static PassedEdge at(double beyond, double relative_radius, double rounding) {
    const double both = relative_radius + rounding;
    return {0.5 * beyond * beyond / both, 0.5 * beyond * (beyond * rounding / both) / relative_radius};
  }
  /// e of a sharp edge's clearance, >= 0.
  static double beyond(double sharp, double relative_radius) { return std::sqrt(2.0 * relative_radius * std::max(0.0, sharp)); }
};

}  // namespace flankwright
