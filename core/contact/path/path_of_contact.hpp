#pragma once

#include <cmath>

#include "core/contact/path/edge_extension.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// The plane of action of a pair, counted in base pitches as Haddad 1991, section 2.3 and fig. 2.1.
///
/// The phase of a point of a contact line is its distance along the line of action from A0, in transverse base pitches. A0 lies
/// 0.35 base pitches before the theoretical start A, B0 as much after the theoretical end E: the extended region in which
/// deflection and errors may bring tip edges into contact (app. 2A). Departures: with many teeth tip edges stay near the mate for longer (edge_extension()), and where
/// a flank's lower end is an edge that reaches further (EdgeReach), A0 or B0 lies as much further out. The phase of a *line* is that of its leading end.
struct PathOfContact {
  static constexpr double extension = EdgeExtension::least;

  explicit PathOfContact(const GearPair& pair);

  double base_pitch;      ///< p_bt [mm]
  EdgeExtension edges;    ///< how far out tip edges may carry load
  double before, beyond;  ///< A0 A and E B0: the extension and what lower edges reach [base pitches]
  double roll_at_start;   ///< pinion roll length at A0 [mm]; may be negative
  double region_length;   ///< A0 B0 [base pitches]
  double slope;           ///< d(phase)/dz, signed with the sense of the contact lines [1/mm]
  double half_face;       ///< of the common face width [mm]

  /// Phase at axial position z of the line whose leading end has phase `line_phase`.
  double phase_at(double line_phase, double z) const { return line_phase - std::abs(slope) * half_face + slope * z; }
  /// Pinion roll length (rho_1 of the undisturbed involutes) at a phase [mm].
  double roll_at(double phase) const { return roll_at_start + phase * base_pitch; }
  /// Line phase of tooth pair 0 when the pinion is at phi1 (phi1 = 0: mid-face pitch point).
  double line_phase_at(double phi1, const GearPair& pair) const;
  /// Its inverse: the pinion angle at which pair 0 has that line phase [rad].
  double pinion_angle_at(double line_phase, const GearPair& pair) const;
  /// Largest line phase at which the line still touches the extended region.
  double last_line_phase() const { return region_length + 2.0 * std::abs(slope) * half_face; }
  /// Phase of E, as `before` is that of A [base pitches].
  double path_end() const { return region_length - beyond; }
};

}  // namespace flankwright
