#pragma once

#include <string>

#include "core/contact/unloaded/transmission_error.hpp"

namespace flankwright {

/// Does the transmission error keep to the predesigned parabola delta_phi2 = offset - a (phi1 - shift)^2, one arc a
/// pitch, merely shifted by misalignment [TM-100260; TM-107451, section 4]?
///
/// Why a parabola absorbs misalignment, and why it needs crowning along the line of contact beside it: removal r_b2 a
/// phi1^2 is the same along the whole line that touches at phi1, so it does not keep a tilted line off its end.
/// Crossing by g_c and intersecting by g_i close the mesh by g (z/cos^2(beta_b) + S tan(beta_b) r_b1 phi1) along the
/// base tangent, g = g_c cos(alpha_wt) - g_i sin(alpha_wt), S the sense of the contact lines (a lead-angle error acts
/// as the crossing it equals). A lead crowning C, a parabola over the face width b, balances the first term at the same
/// position along the face at every phi1,
///
///     z = g b^2/(8 C cos^2(beta_b)),
///
/// and what is left is a straight line of the slope m = S g tan(beta_b) N1/N2. A straight line plus -a phi1^2 is the
/// same parabola with its vertex at m/(2 a). It holds while contact stays on both flanks over the pitch in which a pair
/// is the leading one:
///
///     |z| < b/2,   and   |m/(2 a) - phi1 of the middle of the path of contact at that z| < (eps_alpha - 1)/2 pitch.
///
/// Without crowning, C = 0 sends z to the face end at once. Beyond the second limit contact runs out onto a tip edge
/// before the next pair takes over. Spur gears have m = 0: crossing moves the contact along the face and does not shift
/// the parabola. The resulting coefficient is a K/(K + 2 a), with K = (rho_1^2/r_b2) (1/rho_1 + 1/rho_2) at the point
/// of contact ((rho_2 N1/N2)^2 for rho_1^2 where the wheel is modified): contact slides along the profile to where less
/// is removed.
struct ParabolaCheck {
  double wanted{not_given};    ///< wanted a [1/rad]
  double found{not_given};     ///< a of the best parabola of the carrying pair's arc [1/rad]
  double shift{not_given};     ///< of its vertex from the middle of the mesh, phi1 = 0 of its own tooth [rad of pinion]
  double residual{not_given};  ///< largest distance of the arc from that parabola [rad, wheel]
  /// At every transfer point the leaving pair falls behind (slope <= 0) and the entering one catches up (slope >= 0):
  /// no impact.
  bool right_sign{false};
  /// right_sign, and a found within 10 % of the wanted one, and residual within 5 % of a (pi/N1)^2, and the leading
  /// pair nowhere on a face end.
  bool holds{false};
  std::string why;  ///< one line where it does not hold; empty where it does
};

/// The best parabola, by least squares, through the positions of the mesh, each at the pinion angle of its leading
/// tooth, so that one pitch of the mesh becomes one tooth's arc from transfer point to transfer point. The residual
/// counts the transfer points too.
/// @param mesh    of the same assembly, at least four positions
/// @param wanted  a [1/rad], > 0
/// @throws InvalidInput "parabolic_te" or "positions"
ParabolaCheck check_parabola(const FlankAssembly& assembly, const UnloadedMesh& mesh, double wanted);

}  // namespace flankwright
