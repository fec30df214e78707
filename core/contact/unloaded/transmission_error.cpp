#include "core/contact/unloaded/transmission_error.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "core/contact/unloaded/mesh_envelope.hpp"

namespace flankwright {

namespace {

constexpr int highest_harmonic = 10;

}  // namespace

UnloadedMesh analyse_unloaded_mesh(const GearPair& pair, const FlankAssembly& assembly, int positions) {
  const MeshEnvelope envelope(pair, assembly);
  const double pitch = 2.0 * units::pi / assembly.pinion_teeth;
  UnloadedMesh mesh;
  std::map<int, PairCurve> curves;
  MeshState last;
  double largest = -INFINITY, smallest = INFINITY;
  // One more position closes the cycle, so that transfer points and extremes in its last interval are found too.
  for (int i = 0; i <= positions; ++i) {
    MeshState now = envelope.at(pitch * (static_cast<double>(i) / positions - 0.5), last.exists() ? last.leading().tooth : 0);
    if (i == 0 || i == positions) envelope.look_ahead(now, pitch / positions);
    const double te = now.exists() ? now.leading().transmission_error : not_given;
    if (now.exists()) {
      largest = std::max(largest, te);
      smallest = std::min(smallest, te);
    } else {
      ++mesh.missing;
    }
    envelope.follow(last, now, mesh.transfers, smallest, largest);
    if (i < positions) {
      mesh.phi1.push_back(now.phi1);
      mesh.transmission_error.push_back(te);
      for (const ToothContact& c : now.contacts) {
        if (!envelope.on_path(c.tooth, now.phi1)) continue;
        PairCurve& curve = curves[c.tooth];
        curve.tooth = c.tooth;
        curve.positions.push_back(c);
      }
    }
    last = std::move(now);
  }
  for (auto& [tooth, curve] : curves) mesh.pairs.push_back(std::move(curve));
  if (mesh.missing == 0) {
    mesh.largest = largest;
    mesh.smallest = smallest;
    mesh.peak_to_peak = largest - smallest;
    mesh.harmonics = harmonic_amplitudes(mesh.transmission_error);
  }
  return mesh;
}

std::complex<double> harmonic_phasor(const std::vector<double>& samples, int order) {
  const int n = static_cast<int>(samples.size());
  std::complex<double> sum = 0.0;
  for (int i = 0; i < n; ++i) sum += samples[static_cast<std::size_t>(i)] * std::polar(1.0, -2.0 * units::pi * order * i / n);
  return 2.0 / n * sum;
}

std::vector<double> harmonic_amplitudes(const std::vector<double>& samples) {
  const int n = static_cast<int>(samples.size());
  std::vector<double> amplitudes;
  for (int order = 1; order <= std::min(highest_harmonic, (n - 1) / 2); ++order) amplitudes.push_back(std::abs(harmonic_phasor(samples, order)));
  return amplitudes;
}

}  // namespace flankwright
