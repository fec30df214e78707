#pragma once

#include <complex>
#include <vector>

#include "core/contact/unloaded/tooth_contact.hpp"
#include "core/contact/unloaded/transfer.hpp"

namespace flankwright {

/// Contact of one tooth pair over its run through the mesh, in order of phi1.
struct PairCurve {
  int tooth{0};
  std::vector<ToothContact> positions;
};

/// Unloaded transmission error over one pitch: the envelope of all pairs.
struct UnloadedMesh {
  std::vector<double> phi1;                ///< equally spaced over one pitch around phi1 = 0 [rad]
  std::vector<double> transmission_error;  ///< delta_phi2 at each, wheel [rad]
  std::vector<PairCurve> pairs;            ///< at the same angles, while the pair is on its path, see MeshEnvelope::on_path()
  std::vector<Transfer> transfers;
  /// Extremes of the envelope over the pitch, with both its ends. Transfer points, crests and troughs between positions
  /// are located, so they hardly depend on the number of positions. Wheel [rad]; not given where `missing` > 0.
  double largest{not_given}, smallest{not_given};
  double peak_to_peak{not_given};  ///< largest - smallest [rad]
  std::vector<double> harmonics;   ///< amplitude of orders 1 .. 10 of the pitch, fewer where positions allow fewer [rad]
  int missing{0};                  ///< positions at which no pair touches
};

/// Tooth contact analysis over one pitch of the pinion, phi1 = -pi/N1 .. pi/N1. A transfer point at the very end of the
/// pitch counts there, and not at its start.
///
/// With cumulative pitch errors the next pitch may differ: then everything here is about this pitch alone: the transfer
/// points are those inside it, and the harmonics those of its repetition. Two transfer points between neighbouring
/// positions are both found where either three pairs are involved or the leading one in between has its crest there.
///
/// A pair becomes the leading one only when it is ahead by more than 1e-12 rad, the round-off of the angles, so that
/// aligned pairs that share the load do not transfer contact back and forth.
/// @param pair       for the extended path of contact and the edges' reach, within which a pair's own curve is reported
/// @param positions  >= 1
UnloadedMesh analyse_unloaded_mesh(const GearPair& pair, const FlankAssembly& assembly, int positions);

/// Harmonic of n equally spaced samples of one period, amplitude and phase: 2/n sum s_i exp(-2 pi i k/n).
/// @param order  k, below n/2, >= 1
std::complex<double> harmonic_phasor(const std::vector<double>& samples, int order);
/// Amplitudes of the harmonics 1 .. 10 (at most (n - 1)/2) of n equally spaced samples of one period.
std::vector<double> harmonic_amplitudes(const std::vector<double>& samples);

}  // namespace flankwright
