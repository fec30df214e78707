#include "core/compliance/local/free_end.hpp"

#include <cmath>

namespace flankwright {

namespace {

constexpr double leaning_bluntness = 0.19;  // c'

double leaning_strength(double poissons_ratio, double lean) { return (0.452 + 0.347 * poissons_ratio) * std::expm1(3.6 * lean); }

/// S and L dS/dL.
struct Blunted {
  double value, widening;
};

Blunted blunted(double distance, double half_width, double bluntness) {
  const double share = half_width / (half_width + 2 * distance);
  const double added = bluntness * half_width * share;
  return {distance + added, added * (2 - share)};
}

}  // namespace

FreeEnd::FreeEnd(double poissons_ratio, double lean)
    : strength(poissons_ratio * (0.27 + 1.49 * poissons_ratio)),
      reach(poissons_ratio * (2.15 - 1.6 * poissons_ratio)),
      bluntness(0.15 + 0.3 * poissons_ratio),
      leaning{leaning_strength(poissons_ratio, lean), leaning_strength(poissons_ratio, -lean)},
      leaning_reach(0.2 + 0.95 * poissons_ratio) {}

FreeEnd::Softening FreeEnd::at(const std::array<double, 2>& distances, double depth, double half_width) const {
  const double reached = reach * depth;
  // Products of S and S + a h over the ends, and the sum of L dS/dL / (S (S + a h)) over their common denominator.
  double near = 1, beyond = 1, growth = 0;
  Softening leant{0, 0};
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (std::isinf(distances[i])) continue;
    const Blunted s = blunted(distances[i], half_width, bluntness);
    growth = growth * s.value * (s.value + reached) + s.widening * near * beyond;
    near *= s.value;
    beyond *= s.value + reached;
    if (leaning[i] == 0) continue;
    const Blunted t = blunted(distances[i], half_width, leaning_bluntness);
    const double ratio = leaning_reach * depth / t.value, square = ratio * ratio;
    leant.value += 0.5 * leaning[i] * std::log(1 + square);  // log1p would only keep round-off of plane strain's own 3 to 4
    leant.widening -= leaning[i] * t.widening / t.value * (square / (1 + square));
  }
  const double inverse = 1 / (near * beyond);
  return {strength * std::log(beyond * beyond * inverse) + leant.value, -strength * reached * growth * inverse + leant.widening};
}

}  // namespace flankwright
