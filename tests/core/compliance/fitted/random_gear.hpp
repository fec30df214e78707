#pragma once

#include <vector>

#include "core/compliance/fitted/influence_sample.hpp"
#include "core/compliance/fitted/kernel_form.hpp"
#include "tests/common/random.hpp"

namespace flankwright::testing {

inline GearProportions helical_gear(double face = 12) { return {40, 0.5, face, 0}; }

/// Coefficients of any size that a fit may come by; uniform in +-size.
inline std::vector<double> random_coefficients(const KernelForm& form, tests::Random32& random, double size = 0.5) {
  std::vector<double> x(static_cast<std::size_t>(form.count()));
  for (double& c : x) c = random(-size, size);
  return x;
}

/// Points anywhere on the flanks of the teeth first .. last, face ends included.
inline std::vector<FlankStation> random_stations(int count, double face, int first, int last, tests::Random32& random) {
  std::vector<FlankStation> stations;
  for (int i = 0; i < count; ++i) {
    const int m = random.integer(first, last);
    const double u = random(-1, 1), zeta = random(0, face);
    stations.push_back({m, u, i % 10 == 0 ? 0.0 : zeta});
  }
  return stations;
}

}  // namespace flankwright::testing
