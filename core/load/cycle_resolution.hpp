#pragma once

#include <functional>
#include <vector>

#include "core/load/contact_peaks.hpp"

namespace flankwright {

/// How much a transmission error of n equally spaced positions changes when every second one is left out: what doubling n/2 to n
/// has still brought. The curve has kinks, where lines begin and end, so that amplitudes converge as 1/n^2 and what is
/// left is about a third of the last change; where points of a fixed rule enter whole, as 1/n: about all of it.
struct CycleConvergence {
  int positions{0};
  double harmonic_change{not_given};      ///< largest over the orders 1 .. 10 that n/2 positions resolve [mm]; NaN where n is odd or < 6
  double peak_to_peak_change{not_given};  ///< [mm]
};
/// @param transmission_error  f_t at equally spaced phases over one base pitch [mm]
CycleConvergence cycle_convergence(const std::vector<double>& transmission_error);

struct ResolutionSearch {
  int fewest{32}, most{1024};  ///< positions, powers of two; fewest >= 32, so that n/2 - 1 resolve most of the 10 orders
  /// Converged where harmonic_change <= max(relative * peak to peak, absolute).
  double relative{0.01};   ///< [-], >= 0
  double absolute{1e-6};   ///< [mm], > 0
};

/// Number of positions over one base pitch that resolves the harmonics of a transmission error.
struct ResolutionChoice {
  CycleConvergence convergence;  ///< at the positions chosen
  bool converged{false};         ///< false: most positions, and still changing
  int failures{0};               ///< positions without a usable load distribution; the search ends there, unconverged
};

/// Doubles from the fewest positions until the harmonics have converged; positions already solved are kept.
ResolutionChoice choose_positions(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque,
                                  const ResolutionSearch& search = {});

}  // namespace flankwright
