#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/contact/gap/flank_touch.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// The points where flanks are nearest in one section, and the change of their gap with the removal from either.
struct NearestPoint {
  double pinion_radius{not_given}, wheel_radius{not_given};  ///< [mm]
  /// A point with its weight in the derivative: one, or on a kink of a flank one on either side of it.
  struct Side {
    double pinion_radius{not_given}, pinion_z{not_given};  ///< of the involute's point, what D is a function of [mm]
    double wheel_radius{not_given}, wheel_z{not_given};
    double by_pinion{0.0}, by_wheel{0.0};  ///< d(gap)/dD of either flank [-]
    double share{0.0};                     ///< of the derivative [-]; both sides' add up to 1
  };
  std::array<Side, 2> sides;
};

/// Gap of unloaded flanks at each contact point, normal to the flank, before load.
struct Gap {
  Eigen::VectorXd total;                ///< g [mm]
  Eigen::VectorXd error;                ///< the part that is not clearance, sign of Haddad's delta_e: metal added is positive [mm]
  std::vector<FlankTouch> touches{};    ///< of each point, in the plane of action or near the placed point
  std::vector<NearestPoint> nearest{};  ///< of each point; WholeSurface only
};

}  // namespace flankwright
