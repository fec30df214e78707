#pragma once

#include <cstdint>
#include <vector>

namespace flankwright {

/// What a tolerance class allows the pitches of one gear, see flank_tolerances() in core/gear/flank_tolerances.hpp.
struct PitchTolerance {
  int teeth{0};            ///< z
  double single{0.0};      ///< f_pT: a pitch deviates by at most this, either way [mm]
  double cumulative{0.0};  ///< F_pT: range of the cumulative deviations over the gear [mm], >= single
  bool operator==(const PitchTolerance&) const = default;
};

/// Cumulative pitch deviations of a gear drawn from a tolerance class [mm], one a tooth:
///
///     P_k = 1/2 E cos(2 pi k / z + a) + n_k
///
/// Run-out E cos: E is half-normal with a third of F_pT - f_pT as its deviation, cut off there; the phase a is uniform. Single teeth n_k
/// are independent and normal; their deviation is such that a single pitch P_k - P_(k-1) has a third of f_pT, and they are cut off so
/// that it never exceeds f_pT. Deviations therefore alternate from tooth to tooth and return to themselves around the gear: the single
/// ones sum to zero, and their range keeps F_pT. These are assumptions about a gear of that class, not part of the standard.
///
/// @param draw  number of the draw; the same one gives the same gear
std::vector<double> drawn_pitch(const PitchTolerance& tolerance, std::uint64_t draw);

}  // namespace flankwright
