#pragma once

#include <cmath>

#include "core/gear/face_range.hpp"
#include "core/gear/flank_frame.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Macro-geometry of one gear in its pair [ISO 21771]. Lengths in mm, angles in rad, transverse section unless said.
struct Gear {
  Member member{Member::Pinion};
  GearData data;
  Hand hand{Hand::Right};
  double reference_radius{not_given};          ///< r
  double base_radius{not_given};               ///< r_b
  double tip_radius{not_given};                ///< r_a
  double tip_form_radius{not_given};           ///< r_Fa: where the flank ends and the tip rounding begins; r_a without one
  double tip_edge_radius{not_given};           ///< of the rounding, in the section across a contact line; 0 without one
  double root_radius{not_given};               ///< r_f
  double working_pitch_radius{not_given};      ///< r_w
  double form_radius{not_given};               ///< r_Ff: where the involute meets the root fillet (undercut considered)
  double active_root_radius{not_given};        ///< start of active profile r_Nf: lowest radius the mate's flank reaches, >= r_Ff
  double generating_profile_shift{not_given};  ///< x_E: that of the rack which leaves the tooth thickness allowance [-], <= x
  double tooth_thickness{not_given};           ///< s_t, transverse arc at the reference circle, as generated
  double tip_thickness{not_given};             ///< s_at, transverse arc at the tip, > 0
  double virtual_teeth{not_given};             ///< z_n of the equivalent spur gear [ISO 6336-1]
  double helix_rate{not_given};                ///< 1/p = tan(beta_b) / r_b: turn of the transverse section per mm of z [rad/mm], >= 0
  FaceRange face;                              ///< where the flank ends before the edges of both end faces begin, usable face width b_F
  bool undercut{false};                        ///< the fillet cuts into the involute
  bool fillet_interference{false};             ///< the mate's tip reaches below the form circle; the path of contact ends there

  /// Transverse pressure angle at radius r >= r_b [rad].
  double pressure_angle_at(double radius) const;
  /// Roll length sqrt(r^2 - r_b^2), also the transverse radius of curvature of the involute [mm]; r >= r_b.
  double roll_length_at(double radius) const;
  /// Transverse arc tooth thickness at radius r >= r_b [mm].
  double tooth_thickness_at(double radius) const;
};

/// An external involute pair on parallel axes: everything that follows from PairData [ISO 21771].
///
/// The path of contact is measured along the line of action from the pinion's base tangent point T1 (roll length of the
/// pinion): active from path_start (A, wheel tip form circle) to path_end (E, pinion tip form circle).
struct GearPair {
  PairData data;
  Gear pinion, wheel;
  double transverse_pressure_angle{not_given};          ///< alpha_t
  double working_transverse_pressure_angle{not_given};  ///< alpha_wt
  double base_helix_angle{not_given};                   ///< |beta_b|
  double working_helix_angle{not_given};                ///< |beta_w|
  double centre_distance{not_given};                    ///< a_w used
  double backlash_free_centre_distance{not_given};      ///< a_w at which the teeth have no backlash
  double backlash{not_given};                           ///< j_wt: circumferential backlash at the working pitch circle, transverse; < 0: jams
  double transverse_base_pitch{not_given};              ///< p_bt
  double face_width{not_given};                         ///< common to both gears, both centred on z = 0
  double transverse_contact_ratio{not_given};           ///< eps_alpha
  double overlap_ratio{not_given};                      ///< eps_beta
  double path_length{not_given};                        ///< T1 T2 = a sin(alpha_wt): rho_1 + rho_2
  double path_start{not_given};                         ///< rho_1 at A
  double path_end{not_given};                           ///< rho_1 at E
  double pitch_point{not_given};                        ///< rho_1 at C

  double total_contact_ratio() const { return transverse_contact_ratio + overlap_ratio; }
  /// The same gears where they touch with their other flanks: the coast side of a pair that is given for its drive side.
  GearPair on_other_flanks() const;
  /// j_wt with the axes at another distance [mm], above the sum of the base radii.
  double backlash_at(double distance) const;
  /// j_bn = j_wt cos(alpha_wt) cos(beta_b): least distance of the flanks at the back [mm, ISO 21771; j_n of DIN 3960].
  double normal_backlash() const { return backlash * std::cos(working_transverse_pressure_angle) * std::cos(base_helix_angle); }
  /// j_r: by how much the axes may come closer until the teeth jam [mm, ISO 21771]; < 0: they do already.
  double radial_backlash() const { return centre_distance - backlash_free_centre_distance; }
  double gear_ratio() const { return static_cast<double>(data.wheel.teeth) / data.pinion.teeth; }
  const Gear& operator[](Member m) const { return m == Member::Pinion ? pinion : wheel; }

  /// +1 where the contact of the working flanks moves towards the tip of the pinion with growing z (right-hand pinion on
  /// its right flank, left-hand pinion on its left flank), -1 for the opposite, 0 for spur gears.
  int contact_line_sense() const;

  /// The end face at which the flank of a gear makes an acute angle with it: +1 for z > 0, -1 for z < 0; of a spur gear as if its sense were +1.
  int acute_end(Member m) const { return (m == Member::Pinion ? 1 : -1) * (contact_line_sense() >= 0 ? 1 : -1); }

  /// The radii that modifications and errors of one gear are measured against.
  FlankFrame flank_frame(Member m) const;
};

}  // namespace flankwright
