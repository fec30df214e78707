#pragma once

#include <limits>

#include "core/base/units.hpp"
#include "core/gear/generation.hpp"

namespace flankwright {

/// Not given by the user: the geometry derives it.
inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// Hand of helix. A right-hand helix turns counter-clockwise with growing z.
enum class Hand { Right, Left };

/// Index of a gear in a pair: 1 is the pinion, 2 the wheel.
enum class Member { Pinion, Wheel };

/// The gear as study files and messages name it: "pinion", "wheel".
constexpr const char* name_of(Member member) { return member == Member::Pinion ? "pinion" : "wheel"; }

/// One of something for each gear.
template <class T>
struct PerGear {
  T pinion{}, wheel{};
  constexpr T& operator[](Member m) { return m == Member::Pinion ? pinion : wheel; }
  constexpr const T& operator[](Member m) const { return m == Member::Pinion ? pinion : wheel; }
  bool operator==(const PerGear&) const = default;
};

/// Flank of the pinion that carries load: right is the drive side, left the coast side.
enum class WorkingFlank { Right, Left };
constexpr const char* name_of(WorkingFlank flank) { return flank == WorkingFlank::Right ? "right" : "left"; }
constexpr WorkingFlank opposite(WorkingFlank flank) { return flank == WorkingFlank::Right ? WorkingFlank::Left : WorkingFlank::Right; }

/// Basic rack in normal modules [ISO 53]; defaults are Haddad's BS 436 rack.
struct RackProfile {
  double addendum{1.0};      ///< h_aP/m_n of the gear, > 0
  double dedendum{1.25};     ///< h_fP/m_n of the gear, > 0
  double root_radius{0.39};  ///< rho_fP/m_n, >= 0 and at most the full tip rounding of the tool

  bool operator==(const RackProfile&) const = default;
};

/// A flat that breaks the edge of flank and tip cylinder or of flank and end face. The edge that touches the mate is the one between flank and flat.
struct EdgeChamfer {
  double amount{0.0};             ///< h_K: how far below the tip circle the flat begins, radially, or from the end face, axially [mm], >= 0; 0: none
  double angle{45 * units::deg};  ///< between flat and tip cylinder or end face, section across the edge [rad], > 0
  double radius{0.0};             ///< of the edge between flank and flat, section across the edge [mm], >= 0; 0: sharp
};

/// The data of one gear of a pair, besides the common rack angles.
struct GearData {
  int teeth{0};               ///< z, >= 5
  double face_width{0.0};     ///< b [mm], > 0
  double profile_shift{0.0};  ///< x, coefficient of the normal module [-]
  /// E_sn: normal tooth thickness at the reference cylinder less that of the profile shift, (pi/2 + 2 x tan(alpha_n)) m_n [mm, ISO 21771], <= 0. Tip
  /// diameter and the centre distance that is not given are those of the profile shift.
  double tooth_thickness_allowance{0.0};
  double tip_diameter{not_given};  ///< d_a [mm]; not given: from rack and profile shift
  RackProfile rack;
  double tip_rounding{0.0};  ///< radius of the edge between flank and tip cylinder, section across the edge [mm], >= 0; 0: sharp
  EdgeChamfer tip_chamfer;   ///< instead of a tip rounding
  double end_rounding{0.0};  ///< radius of the edges between flank and end faces, section across the edge [mm], >= 0; 0: sharp
  EdgeChamfer end_chamfer;   ///< instead of an end rounding
  Generation generation;     ///< what cuts the flanks

  /// Radius of the edge where the flank ends towards the tip, section across it [mm]; 0: sharp.
  double tip_edge_radius() const { return tip_chamfer.amount > 0.0 ? tip_chamfer.radius : tip_rounding; }
  /// The same towards both end faces.
  double end_edge_radius() const { return end_chamfer.amount > 0.0 ? end_chamfer.radius : end_rounding; }
};

/// The data of an external parallel-axis involute pair [ISO 21771].
struct PairData {
  double normal_module{0.0};               ///< m_n [mm], > 0
  double pressure_angle{20 * units::deg};  ///< alpha_n, normal section [rad], 10 .. 35 deg
  double helix_angle{0.0};                 ///< |beta| at the reference cylinder [rad], 0 .. 45 deg
  double centre_distance{not_given};       ///< a [mm]; not given: free of backlash but for the tooth thickness allowances
  Hand pinion_hand{Hand::Right};           ///< of the pinion, the wheel's is the opposite
  Member driver{Member::Pinion};           ///< which gear drives
  WorkingFlank working_flank{WorkingFlank::Right};
  GearData pinion, wheel;

  GearData& operator[](Member m) { return m == Member::Pinion ? pinion : wheel; }
  const GearData& operator[](Member m) const { return m == Member::Pinion ? pinion : wheel; }
};

/// Linear elastic material of one gear.
struct Material {
  double youngs_modulus{206000.0};  ///< E [MPa], > 0
  double poissons_ratio{0.3};       ///< nu, 0 <= nu < 0.5
};

}  // namespace flankwright
