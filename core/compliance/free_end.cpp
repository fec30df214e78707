#include "core/compliance/free_end.hpp"

#include <cmath>

namespace flankwright {

FreeEnd::FreeEnd(double poissons_ratio)
    : strength(poissons_ratio * (0.27 + 1.49 * poissons_ratio)),
      reach(poissons_ratio * (2.15 - 1.6 * poissons_ratio)),
      bluntness(0.15 + 0.3 * poissons_ratio) {}

FreeEnd::Softening FreeEnd::at(double distance, double depth, double half_width) const {
  if (std::isinf(distance)) return {0, 0};
  const double share = half_width / (half_width + 2 * distance);
  const double s = distance + bluntness * half_width * share;
  const double grown = bluntness * half_width * share * (2 - share);  // L dS/dL
  const double reached = reach * depth;
  return {std::log1p(reached / s), -reached * grown / (s * (s + reached))};
}

}  // namespace flankwright
