#include "core/load/cycle_resolution.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/contact/transmission_error.hpp"

namespace flankwright {

namespace {

double peak_to_peak(const std::vector<double>& samples) {
  const auto [low, high] = std::ranges::minmax(samples);
  return high - low;
}

void check(const ResolutionSearch& search) {
  if (search.fewest < 32 || search.most < search.fewest) {
    throw InvalidInput("positions of the search", std::to_string(search.fewest) + " .. " + std::to_string(search.most),
                       "at least 32, and no fewer at most than at least");
  }
  if (!(search.relative >= 0.0 && search.absolute > 0.0)) {
    throw InvalidInput("tolerance of the harmonics", std::to_string(search.absolute), "above 0");
  }
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

ResolutionChoice choose_positions(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque,
                                  const ResolutionSearch& search) {
  check(search);
  ResolutionChoice choice;
  std::vector<double> error;  // of n positions, by phase
  for (int n = search.fewest;; n *= 2) {
    std::vector<double> phases = equally_spaced_phases(n);
    const bool refines = !error.empty();
    if (refines) {
      std::vector<double> odd;
      for (std::size_t i = 1; i < phases.size(); i += 2) odd.push_back(phases[i]);
      phases = odd;
    }
    const LoadedCycle cycle = analyse_cycle(mesh_at(phases), condition, pinion_torque);
    choice.failures += cycle.failures;
    const Eigen::VectorXd found = cycle.transmission_error();
    std::vector<double> merged;
    for (std::size_t i = 0; i < phases.size(); ++i) {
      if (refines) merged.push_back(error[i]);
      merged.push_back(found[static_cast<Eigen::Index>(i)]);
    }
    error = std::move(merged);
    choice.convergence = cycle_convergence(error);
    if (choice.failures > 0) return choice;
    choice.converged = choice.convergence.harmonic_change <= std::max(search.relative * peak_to_peak(error), search.absolute);
    if (choice.converged || 2 * n > search.most) return choice;
  }
}

}  // namespace flankwright
