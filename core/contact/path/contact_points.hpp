#pragma once

#include <optional>
#include <vector>

#include "core/contact/path/path_of_contact.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Quadrature rule on the intervals of a contact line.
enum class QuadratureRule {
  Gauss2,
  Gauss3,
  Midpoint,  ///< on equal intervals at fixed axial positions: points enter and leave as the line passes them
  Graded,    ///< two Gauss points on intervals that end where the line does, see line_intervals()
};

/// The resolution of contact lines.
struct Quadrature {
  QuadratureRule rule{QuadratureRule::Gauss2};
  int intervals{5};  ///< over the common face width; Graded: over the part of a line between A and E, >= 1
};

/// Part of a contact line, along the axis.
struct LineInterval {
  double begin, end;  ///< z [mm], begin < end
};

/// The intervals of one line, by rising z.
///
/// Fixed rules: equal ones over the common face width, whatever the line's phase. Graded: the line is cut where it
/// enters and leaves the extended region (A0, B0) and the theoretical path (A, E), so that points move with the line
/// and integrals over it are smooth functions of the phase. Between A and E
///
///     z_j = z_A + (z_E - z_A) (1 - cos(pi j/n))/2,   j = 0 .. n,
///
/// narrow at the ends, where the load rises or falls within a few tenths of a module; on either extended part, where
/// load falls to 0 a little way beyond A or E, max(6, n/2 + 3) intervals that grow as the square of the distance from there, and as many where edges
/// reach further out.
/// @param line_phase  of the line's leading end [base pitches]
std::vector<LineInterval> line_intervals(const PathOfContact& path, const Quadrature& quadrature, double line_phase, double face_start,
                                         double face_end);

/// The nearest tip edge of a point, in the section across its contact line.
struct TipEdge {
  Member gear{Member::Pinion};
  double radius{not_given};    ///< of the rounding [mm]; 0: sharp, NaN: no edge
  double distance{not_given};  ///< along the flank to the start of the rounding, < 0 where contact is beyond it [mm]
  double rounded_off{0.0};     ///< part of the sharp form circle's clearance that the rounding fills [mm]
};

/// One quadrature point of a contact line in the plane of action, with the unmodified geometry around it. Lengths in mm.
struct ContactPoint {
  int tooth{0};        ///< tooth pair, k pitches ahead of the reference pair 0
  double z{0.0};       ///< axial position, 0 at mid face
  double phase{0.0};   ///< [base pitches] from A0
  double weight{0.0};  ///< length of contact line that belongs to it, > 0: sum(weight * line load) is the normal force
  double pinion_radius{not_given}, wheel_radius{not_given};
  double relative_radius{not_given};                       ///< rho_1 rho_2 / (rho_1 + rho_2) / cos(beta_b), normal section [Haddad 1991, eq. 2.15]
  double pinion_depth{not_given}, wheel_depth{not_given};  ///< h = (s_yt/2) cos(beta_b) / cos(alpha_yt), flank to tooth centre
  double pinion_tip_distance{not_given}, wheel_tip_distance{not_given};  ///< (r_a - r_y) / cos(alpha_yt)
  int interval{-1};       ///< of its line, where two Gauss points of the rule Graded share one; -1: none
  double clearance{0.0};  ///< c_n of the unmodified pair, normal to the flank; 0 on the theoretical path of contact
  TipEdge tip_edge{};
};

/// Fills radii, curvature, depths and tip distances of a point from its roll lengths on both gears [mm], both > 0.
void set_rolls(const GearPair& pair, double pinion_roll, double wheel_roll, ContactPoint& point);
/// The point of one line at an axial position, without a weight; nothing where no contact can be.
/// @param line_phase, with_extended_region  as in contact_points()
std::optional<ContactPoint> contact_point(const GearPair& pair, const PathOfContact& path, double line_phase, int tooth, double z,
                                          bool with_extended_region);

/// Contact points of all teeth at one mesh position.
///
/// No point moves while modifications change. Between A and E both flanks touch in the base tangent plane. Between A0
/// and A the wheel's tip edge meets the pinion flank off that plane, between E and B0 the pinion's tip edge the wheel
/// flank; clearance and contact radii there are solved exactly in the transverse section [Haddad 1991, app. 2A,
/// 2A.2-2A.17; solved here in closed form: the tip's position is known, and the mate's flank angle at that radius is
/// explicit]. With a tip rounding the edge that meets the mate is its form circle's, and the rounding fills the part rho/(R + rho) of the
/// clearance: that of two parabolas, see RoundedEdge. Departure: where the path ends at a form circle, because the mate's tip reaches below it
/// (Gear::fillet_interference), the lower end of the flank is an edge that runs along the mate's flank, from where it
/// enters the mate's tip circle (EdgeReach); further out the mate's tip edge meets the flank. Clearances there are the
/// turn that the wheel lacks.
/// @param line_phase  of tooth pair 0 [base pitches], see PathOfContact
/// @param with_extended_region  false leaves out A0 .. A and E .. B0
std::vector<ContactPoint> contact_points(const GearPair& pair, const PathOfContact& path, const Quadrature& quadrature, double line_phase,
                                         bool with_extended_region, double face_start, double face_end);

}  // namespace flankwright
