#pragma once

#include <vector>

#include "core/gear/gear_data.hpp"

namespace flankwright {

/// The change of a transmission error of n equally spaced positions when every second one is left out: the effect of
/// doubling n/2 to n. The curve has kinks, where lines begin and end, so that amplitudes converge as 1/n^2 and the
/// remaining error is about a third of the last change; where points of a fixed rule enter whole they converge as 1/n,
/// and it is about all of it.
struct CycleConvergence {
  int positions{0};
  double harmonic_change{not_given};      ///< largest over the orders 1 .. 10 that n/2 positions resolve [mm]; NaN where n is odd or < 6
  double peak_to_peak_change{not_given};  ///< [mm]
};
/// @param transmission_error  f_t at equally spaced phases over one base pitch [mm]
CycleConvergence cycle_convergence(const std::vector<double>& transmission_error);

}  // namespace flankwright
