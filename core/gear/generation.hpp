#pragma once

#include <limits>
#include <variant>

namespace flankwright {

/// The flank is cut by a rack with straight flanks: an involute helicoid.
struct StraightRack {};

/// The flank is cut by a rack-cutter whose profile in the normal section is a parabola [TM-107451, app. 5, a_c of A.5.7].
/// With u [mm] along the straight profile, 0 on the rolling line and growing towards the gear's tip, the cutting edge lies
/// a_c u^2 beside the straight one, measured normal to it into the tooth. It touches the straight rack where u = 0 and leaves
/// the tooth unchanged at the gear's reference circle, thinner everywhere else (crowned).
struct ParabolicRack {
  double coefficient{0.0};  ///< a_c [1/mm], >= 0, at most largest_parabola_coefficient()
};

/// The flank of a spur gear is cut by a surface of revolution that rolls with the gear like a rack [TM-100260]: a hollow cone, or
/// an arc instead of its generatrix, that holds the tooth inside. The cone touches the straight rack along the generatrix in mid
/// face; the arc touches the generatrix on the rolling line.
struct RevolutionTool {
  double half_apex{0.0};                                       ///< alpha, between generatrix and axis of the cone [rad], 0 < alpha < pi/2
  double distance{0.0};                                        ///< d, height of the cone from its apex to its rim along the axis [mm], > 0
  double arc_radius{std::numeric_limits<double>::infinity()};  ///< rho of the arc [mm], > 0; infinite: the cone
};

/// The tool that cut a flank.
using Generation = std::variant<StraightRack, ParabolicRack, RevolutionTool>;

}  // namespace flankwright
