#pragma once

#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Coefficient a >= 0 [rad/rad^2] of the parabola of transmission error phi2 = (N1/N2) phi1 - a phi1^2 that the arc of a
/// RevolutionTool on one spur gear gives with an involute mate: the exact curvature at the vertex, where the gear's reference
/// circle is in contact.
///
///     a = tan^2(alpha) r_b1^2 / (2 r_b2 (rho + rho_rel)),      rho_rel = rho_1 rho_2 / (rho_1 + rho_2)
///
/// rho_1 and rho_2 being the radii of curvature of the involutes in contact there. With both gears on their reference circles
/// this is TM-100260, eq. 8, m21' = -2 a, with the factor N1/N2 that the paper leaves out. The same for a tool on the wheel.
/// @param arc_radius  rho [mm], > 0; infinite gives 0
/// @throws InvalidInput "arc_radius", or "pair.helix_angle" for a helical pair
double parabola_of_arc(const GearPair& pair, Member member, double arc_radius);

}  // namespace flankwright
