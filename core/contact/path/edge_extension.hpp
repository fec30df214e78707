#pragma once

#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// How far outside the path of contact a tip edge may carry load [transverse base pitches].
struct EdgeExtension {
  static constexpr double least = 0.35;  ///< Haddad 1991, section 2.3
  double before{0.0};                    ///< the wheel's edge, before the path's start A
  double beyond{0.0};                    ///< the pinion's, beyond the path's end E
};

/// EdgeExtension::least, or further where a tip edge of flanks without modification is still nearer to the mate there than
/// 0.03 m_n. So much is the deflection of a single tooth pair at 400 N per mm of face and of m_n, with 14 N/(mm um), which no root carries. With many teeth an edge
/// stays near: at 0.35 base pitches it is 0.055 m_n away with teeth 24 and 60, 0.009 m_n with teeth 100 and 150.
///
/// The pinion's edge, at r_a1, has turned by e p_bt / r_b1 since it was at E. From the triangle of both centres and the edge, with angles from the line of centres,
///
///     psi_1 = alpha_a1 - alpha_wt + e p_bt / r_b1,    tan psi_2 = r_a1 sin psi_1 / (a - r_a1 cos psi_1),
///     gap = r_b2 (psi_2(0) + inv alpha_2(r) - inv alpha_2(r_E) + e p_bt / r_b2 - psi_2),
///
/// r its distance from the wheel's centre, r_E that at E. The wheel's edge before A is the same with the gears exchanged. The edge cannot touch once it is outside
/// the mate's tip circle.
EdgeExtension edge_extension(const GearPair& pair);

}  // namespace flankwright
