#pragma once

#include <algorithm>
#include <cmath>

#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Distance outside the path of contact at which the lower end of a profile, an edge, may touch the mate [transverse
/// base pitches], >= 0.
struct EdgeReach {
  double before{0.0};  ///< the pinion's form circle, before the path's start A
  double beyond{0.0};  ///< the wheel's, beyond the path's end E
};

/// Where the mate's tip reaches below a form circle (Gear::fillet_interference) the path of contact begins not where
/// the flank enters the mate's tip circle but later, at the form circle on the line of action. All the while the
/// flank's lower end, an edge there, runs along the mate's flank, close to it: near the base circle the edge follows
/// the mate's involute. From the triangle of both centres and the point where the form circle crosses the mate's tip
/// circle,
///
///     cos psi = (r_F1^2 + a^2 - r_a2^2) / (2 a r_F1),     reach = r_b1 (psi + alpha_t1(r_F1) - alpha_wt) / p_bt
///
/// from there to the line of action. It is 0 where the mate's tip crosses the line of action first, at A, and grows from there without a step.
inline EdgeReach edge_reach(const GearPair& pair) {
  const auto reach_of = [&](const Gear& gear, const Gear& mate) {
    const double form = std::max(gear.form_radius, gear.base_radius), a = pair.centre_distance, tip = mate.tip_form_radius;
    // Clamped where the form circle stays outside the mate's tip circle: psi = 0 then, and no reach below the pitch circle.
    const double cosine = std::clamp((form * form + (a - tip) * (a + tip)) / (2.0 * a * form), -1.0, 1.0);
    const double turn = std::acos(cosine) + gear.pressure_angle_at(form) - pair.working_transverse_pressure_angle;
    return std::max(0.0, gear.base_radius * turn / pair.transverse_base_pitch);
  };
  return {reach_of(pair.pinion, pair.wheel), reach_of(pair.wheel, pair.pinion)};
}

}  // namespace flankwright
