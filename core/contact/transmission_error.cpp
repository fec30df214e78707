#include "core/contact/transmission_error.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "core/contact/path_of_contact.hpp"

namespace flankwright {

namespace {

constexpr double lead_tolerance = 1e-12;  // rad, see analyse_unloaded_mesh()
constexpr int highest_harmonic = 10;

/// All pairs that may touch at one pinion angle, and which of them leads.
class MeshAtAngle {
 public:
  MeshAtAngle(const MeshScene& scene, int reach, double phi1, int preferred) {
    for (int k = -reach; k <= reach; ++k) {
      const ToothContact contact = find_tooth_contact(scene, k, phi1);
      if (contact.exists()) contacts_.push_back(contact);
    }
    for (const ToothContact& c : contacts_) {
      const bool leads = !leader_ || c.transmission_error > leader_->transmission_error + lead_tolerance;
      const bool stays = leader_ && c.tooth == preferred &&
                         c.transmission_error >= leader_->transmission_error - lead_tolerance;
      if (leads || stays) leader_ = &c;
    }
  }
  MeshAtAngle(const MeshAtAngle&) = delete;
  MeshAtAngle& operator=(const MeshAtAngle&) = delete;

  const std::vector<ToothContact>& contacts() const { return contacts_; }
  const ToothContact* leader() const { return leader_; }

 private:
  std::vector<ToothContact> contacts_;
  const ToothContact* leader_{nullptr};
};

/// Halves (from, to] until the hand-over from `tooth` is located to round-off of the angle.
Transfer locate_transfer(const MeshScene& scene, int reach, int tooth, double from, double to) {
  Transfer transfer;
  transfer.from_tooth = tooth;
  while (true) {
    const double middle = 0.5 * (from + to);
    if (middle <= from || middle >= to || to - from <= 1e-13) break;
    const MeshAtAngle mesh(scene, reach, middle, tooth);
    const bool same = mesh.leader() && mesh.leader()->tooth == tooth;
    (same ? from : to) = middle;
  }
  const MeshAtAngle mesh(scene, reach, to, tooth);
  transfer.phi1 = to;
  if (mesh.leader()) {
    transfer.to_tooth = mesh.leader()->tooth;
    transfer.transmission_error = mesh.leader()->transmission_error;
  }
  return transfer;
}

}  // namespace

UnloadedMesh analyse_unloaded_mesh(const GearPair& pair, const MeshScene& scene, int positions) {
  const PathOfContact path(pair);
  const double pitch = 2.0 * units::pi / scene.pinion_teeth;
  const int reach = static_cast<int>(std::ceil(path.last_line_phase())) + 1;
  UnloadedMesh mesh;
  std::map<int, PairCurve> curves;
  int leader = 0;
  double largest = -INFINITY, smallest = INFINITY;
  const auto note = [&](double te) {
    largest = std::max(largest, te);
    smallest = std::min(smallest, te);
  };
  // One position more than asked closes the cycle, so that a hand-over in its last interval is found too.
  for (int i = 0; i <= positions; ++i) {
    const double phi1 = pitch * (static_cast<double>(i) / positions - 0.5);
    const MeshAtAngle now(scene, reach, phi1, leader);
    if (!now.leader()) {
      ++mesh.missing;
      if (i < positions) {
        mesh.phi1.push_back(phi1);
        mesh.transmission_error.push_back(not_given);
      }
      continue;
    }
    if (i > 0 && now.leader()->tooth != leader) {
      mesh.transfers.push_back(locate_transfer(scene, reach, leader, phi1 - pitch / positions, phi1));
      note(mesh.transfers.back().transmission_error);
    }
    leader = now.leader()->tooth;
    if (i == positions) break;
    mesh.phi1.push_back(phi1);
    mesh.transmission_error.push_back(now.leader()->transmission_error);
    note(now.leader()->transmission_error);
    for (const ToothContact& c : now.contacts()) {
      const double phase = path.line_phase_at(phi1 + c.tooth * pitch, pair);
      if (phase < 0.0 || phase > path.last_line_phase()) continue;
      PairCurve& curve = curves[c.tooth];
      curve.tooth = c.tooth;
      curve.positions.push_back(c);
    }
  }
  for (auto& [tooth, curve] : curves) mesh.pairs.push_back(std::move(curve));
  if (mesh.missing == 0) {
    mesh.peak_to_peak = largest - smallest;
    mesh.harmonics = harmonic_amplitudes(mesh.transmission_error);
  }
  return mesh;
}

std::vector<double> harmonic_amplitudes(const std::vector<double>& samples) {
  const int n = static_cast<int>(samples.size());
  std::vector<double> amplitudes;
  for (int order = 1; order <= std::min(highest_harmonic, (n - 1) / 2); ++order) {
    std::complex<double> sum = 0.0;
    for (int i = 0; i < n; ++i) sum += samples[i] * std::polar(1.0, -2.0 * units::pi * order * i / n);
    amplitudes.push_back(2.0 * std::abs(sum) / n);
  }
  return amplitudes;
}

}  // namespace flankwright
