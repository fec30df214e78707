#pragma once

#include <vector>

#include "core/contact/path/path_of_contact.hpp"
#include "core/contact/unloaded/tooth_contact.hpp"
#include "core/contact/unloaded/transfer.hpp"

namespace flankwright {

/// All pairs that may touch at one pinion angle, and the leading one.
struct MeshState {
  double phi1{not_given};
  std::vector<ToothContact> contacts;  ///< those that exist, in order of tooth
  int leading_index{-1};               ///< index into contacts, -1 where no pair touches

  bool exists() const { return leading_index >= 0; }
  const ToothContact& leading() const { return contacts[leading_index]; }
  /// Contact of one pair, null where it does not touch.
  const ToothContact* of(int tooth) const;
};

/// The envelope of all tooth pairs as a function of the pinion angle: states of the mesh, and what happens between two of them.
///
/// Only pairs within a quarter of a pitch of the extended path of contact are in mesh; others are ignored, for the
/// envelope and the transfer points alike. A pair beyond that is 0.6 base pitches or more outside the path, or outside
/// the reach of edges, along every part of the face, where flanks have parted by about a tenth of the module, while
/// another pair is inside it at the same position along the face: the contact ratio is above 1.
class MeshEnvelope {
 public:
  static constexpr double leading_tolerance = 1e-12;  ///< rad, see analyse_unloaded_mesh()

  MeshEnvelope(const GearPair& pair, const FlankAssembly& assembly);

  /// Whether pair `tooth` is on the extended path of contact with the pinion at phi1.
  bool on_path(int tooth, double phi1) const { return is_within(tooth, phi1, 0.0); }

  /// @param preferred  tooth that stays the leading one unless another is ahead of it by more than leading_tolerance
  MeshState at(double phi1, int preferred) const;

  /// Where pairs are ahead together, within leading_tolerance, the leading one is that which leads another `step` [rad]
  /// on. So a transfer point that falls on both ends of a pitch belongs to the upper end.
  void look_ahead(MeshState& state, double step) const;

  /// Evaluates the range between two states, `from` before `to`: appends transfer points to `transfers`, in order, and
  /// widens smallest .. largest by the crests and troughs of the leading pair.
  void follow(const MeshState& from, const MeshState& to, std::vector<Transfer>& transfers, double& smallest, double& largest) const;

 private:
  struct Sample;

  /// The same with as much more on both sides [base pitches].
  bool is_within(int tooth, double phi1, double beyond) const;
  ToothContact contact(int tooth, double phi1) const;
  void follow_pair(const ToothContact& from, const ToothContact& to, double& smallest, double& largest) const;
  double hidden_transfer(const MeshState& from, const MeshState& to) const;
  double transfer_point(const MeshState& from, const MeshState& to) const;

  const GearPair& pair_;
  ToothContactSolver solver_;
  PathOfContact path_;
  double pitch_;  ///< 2 pi/N1 [rad]
};

}  // namespace flankwright
