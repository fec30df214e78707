#include "core/compliance/free_end.hpp"

#include <cmath>

namespace flankwright {

FreeEnd::FreeEnd(double poissons_ratio)
    : strength(poissons_ratio * (0.27 + 1.49 * poissons_ratio)),
      reach(poissons_ratio * (2.15 - 1.6 * poissons_ratio)),
      bluntness(0.15 + 0.3 * poissons_ratio) {}

FreeEnd::Softening FreeEnd::at(const std::array<double, 2>& distances, double depth, double half_width) const {
  const double reached = reach * depth;
  // Products of S and S + a h over the ends, and the sum of L dS/dL / (S (S + a h)) over their common denominator.
  double near = 1, beyond = 1, growth = 0;
  for (const double distance : distances) {
    if (std::isinf(distance)) continue;
    const double share = half_width / (half_width + 2 * distance);
    const double blunted = bluntness * half_width * share;
    const double s = distance + blunted;
    growth = growth * s * (s + reached) + blunted * (2 - share) * near * beyond;
    near *= s;
    beyond *= s + reached;
  }
  const double inverse = 1 / (near * beyond);
  return {std::log(beyond * beyond * inverse), -reached * growth * inverse};
}

}  // namespace flankwright
