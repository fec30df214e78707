#include "core/fidelity/cycle_resolution.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/unloaded/transmission_error.hpp"

namespace flankwright {

namespace {

double peak_to_peak(const std::vector<double>& samples) {
  const auto [low, high] = std::ranges::minmax(samples);
  return high - low;
}

}  // namespace

CycleConvergence cycle_convergence(const std::vector<double>& transmission_error) {
  CycleConvergence convergence;
  convergence.positions = static_cast<int>(transmission_error.size());
  if (transmission_error.size() < 6 || transmission_error.size() % 2 != 0) return convergence;
  std::vector<double> half;
  for (std::size_t i = 0; i < transmission_error.size(); i += 2) half.push_back(transmission_error[i]);
  const std::vector<double> fine = harmonic_amplitudes(transmission_error), coarse = harmonic_amplitudes(half);
  convergence.harmonic_change = 0.0;
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    convergence.harmonic_change = std::max(convergence.harmonic_change, std::abs(fine[k] - coarse[k]));
  }
  convergence.peak_to_peak_change = peak_to_peak(transmission_error) - peak_to_peak(half);
  return convergence;
}

}  // namespace flankwright
