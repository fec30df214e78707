#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/contact/path/contact_points.hpp"
#include "core/contact/assembly/flank_condition.hpp"
#include "core/contact/gap/flank_touch.hpp"

namespace flankwright {

/// How the gap between the flanks is found.
enum class GapModel {
  PlaneOfAction,  ///< near where undisturbed flanks would touch, see plane_of_action_gap()
  WholeSurface,   ///< over the whole flanks, see SurfaceGap
};

/// Name of the model in a study file ("whole_surface").
const char* to_string(GapModel model);

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

/// Gap of unloaded flanks at each contact point, normal to the flank, at the angle at which the undisturbed pair would touch [mm]:
///
///     g = touch + misalignment
///
/// The touch is that of both flanks with their clearance and deviations in the section of the point, see FlankTouchSearch; it moves along the profile
/// with the wheel. Misalignment is the wheel's displacement along the pinion's outward normal, first order in the angles; a changed pinion helicoid (lead
/// or pressure-angle error) enters by the exact angle between the changed and the nominal flank. Both are those of the plane of action. Negative where
/// metal is added or the wheel is pushed into the pinion.
Gap plane_of_action_gap(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition);

/// dg/dp at each point for one modification parameter of one gear [mm/mm; parabolic_te mm rad], exact.
/// @param gap  as plane_of_action_gap() gave it
Eigen::VectorXd gap_derivative(const GearPair& pair, const std::vector<ContactPoint>& points, const Gap& gap, const FlankCondition& condition,
                               Member member, ModificationParameter parameter);

}  // namespace flankwright
