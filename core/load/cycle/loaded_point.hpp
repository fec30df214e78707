#pragma once

#include <cmath>

#include "core/base/units.hpp"
#include "core/load/cycle/loaded_cycle.hpp"
#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

/// A contact point with the largest line load and pressure of the part of a contact line that belongs to it.
struct LoadedPoint {
  const ContactPoint& point;
  double line_load{not_given};  ///< [N/mm], >= 0
  double pressure{not_given};   ///< [MPa], >= 0; that on a tip edge where contact reaches it
};

/// Point i of a solved position.
inline LoadedPoint loaded_point(const MeshPosition& at, const LoadedPosition& loaded, Eigen::Index i) {
  return {at.points[static_cast<std::size_t>(i)], loaded.peak_load[i], loaded.contact_stress[i]};
}

/// A point of the flanks away from edges under a line load, with Hertz's pressure.
inline LoadedPoint flank_point(const ContactPoint& point, double contact_modulus, double line_load) {
  return {point, line_load, std::sqrt(line_load * contact_modulus / (units::pi * point.relative_radius))};
}

}  // namespace flankwright
