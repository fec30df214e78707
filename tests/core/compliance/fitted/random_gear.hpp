#pragma once

#include <random>
#include <vector>

#include "core/compliance/fitted/influence_sample.hpp"
#include "core/compliance/fitted/kernel_form.hpp"

namespace flankwright::testing {

inline GearProportions helical_gear(double face = 12) { return {40, 0.5, face, 0}; }

/// Coefficients of any size that a fit may come by; uniform in +-size.
inline std::vector<double> random_coefficients(const KernelForm& form, std::mt19937& random, double size = 0.5) {
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<double> x(static_cast<std::size_t>(form.count()));
  for (double& c : x) c = uniform(random);
  return x;
}

/// Points anywhere on the flanks of the teeth first .. last, face ends included.
inline std::vector<FlankStation> random_stations(int count, double face, int first, int last, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  std::uniform_int_distribution<int> tooth(first, last);
  std::vector<FlankStation> stations;
  for (int i = 0; i < count; ++i) {
    const int m = tooth(random);
    const double u = -1 + 2 * share(random), zeta = face * share(random);
    stations.push_back({m, u, i % 10 == 0 ? 0.0 : zeta});
  }
  return stations;
}

}  // namespace flankwright::testing
