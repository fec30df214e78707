#pragma once

#include <vector>

#include "core/base/error.hpp"
#include "core/gear/pair_geometry.hpp"

namespace flankwright {

/// Where a flank ends towards the tip, and the curvature of the rounded edge there: fills tip_form_radius and tip_edge_radius of a gear that
/// has its other radii.
///
/// Across the edge both tangent planes, of flank and tip cylinder, meet at the sharp tip, their normals at gamma, and the arc touches each at
/// rho tan(gamma/2) from there. With a chamfer the planes of flank and flat meet at h_K below the tip, at gamma less the flat's angle; what flank
/// and cylinder bend over that length is left out. On the flank's tangent plane the edge runs at delta from the contact line [flank's normal
/// n = cos(beta_b) t - sin(beta_b) z, contact line g = sin(beta_b) t + cos(beta_b) z, with the radial direction t' = sin(alpha_at)]:
///
///     cos gamma = cos(beta_b) sin(alpha_at),   tan delta = sin(beta_b) tan(alpha_at).
///
/// Along the profile, which is across the contact line, the arc begins at rho tan(gamma/2)/cos(delta) from the tip, and by Euler's theorem its
/// radius there is rho/cos^2(delta). An involute's arc length is rho_y^2/(2 r_b).
void set_tip_edge(Gear& gear);

/// Where the flank ends towards both end faces.
///
/// The edge of flank and end face is the profile, to which the contact line g is perpendicular. In the plane of g and the flank's normal the end
/// face lies at 90 deg + beta_b between both normals at the acute end, at 90 deg - beta_b at the obtuse one. The arc touches the flank at
/// r tan(gamma/2) from the edge along g, and g advances by cos(beta_b) along the axis. A chamfer ends the flank at its amount already, where its own
/// edge has gamma less the chamfer's angle. What is left is the usable face width b_F [ISO 21771].
/// @param acute_end  +1 or -1: the sign of z at the acute end
FaceRange flank_range(const Gear& gear, int acute_end);

/// Radius of the edges of a flank of which nothing is known [mm]: 0.05 m_n, as deburring and tumbling leave them, and at most a quarter of the
/// tooth's thickness at the tip. 0 where the tooth is pointed.
/// @param gear  with its radii and tooth thickness
double usual_edge_radius(const Gear& gear, double normal_module);

/// What is wrong with the edges of a gear that has its radii.
/// @param form_radius  where the flank begins [mm]
/// @param name         of the gear in messages
std::vector<InvalidInput> find_edge_problems(const Gear& gear, double form_radius, const std::string& name);

/// Whether a tip chamfer leaves part of the tip, and turns from the flank towards it; one condition of find_edge_problems().
bool leaves_room_for_tip_chamfer(const Gear& gear);

}  // namespace flankwright
