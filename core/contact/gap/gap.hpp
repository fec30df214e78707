#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/contact/path/contact_points.hpp"
#include "core/contact/assembly/flank_condition.hpp"
#include "core/flank/flank.hpp"

namespace flankwright {

/// How the gap between the flanks is found.
enum class GapModel {
  PlaneOfAction,  ///< where undisturbed flanks would touch, see plane_of_action_gap()
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
  std::vector<NearestPoint> nearest{};  ///< of each point; WholeSurface only
};

/// Gap of unloaded flanks at each contact point, normal to the flank, at the angle at which the undisturbed pair would touch [mm]:
///
///     g = c_n + cos(beta_b) sum over both gears of D (see Flank) + misalignment
///
/// Contact stays where the undisturbed flanks would touch (plane of action). Misalignment is the wheel's displacement
/// along the pinion's outward normal, first order in the angles; a changed pinion helicoid (lead or pressure-angle error) enters by the
/// exact angle between the changed and the nominal flank. Negative where metal is added or the wheel is pushed into the pinion.
Gap plane_of_action_gap(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition);

/// dg/dp at each point for one modification parameter of one gear [mm/mm; parabolic_te mm rad], exact.
Eigen::VectorXd gap_derivative(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition, Member member,
                               ModificationParameter parameter);

/// How far the deviations of a condition move a point's tip edge away from the contact: with a slope h' of the gap along the flank, towards the edge,
/// parabola and slope together touch at s = -R h', so that the edge is R h' further off. Relief that rises to the tip keeps contact from its edge.
/// Between kinks of a deviation, to first order.
class TipEdgeShift {
 public:
  /// -h' of the steepest flank that is expected to close towards its edge [-]: 100 um in a mm.
  static constexpr double steepest = 0.1;

  /// @param pair  must outlive this
  TipEdgeShift(const GearPair& pair, const FlankCondition& condition);
  /// [mm]; 0 where the point has no edge
  double at(const ContactPoint& point) const;

 private:
  const GearPair& pair_;
  Misalignment misalignment_;
  PerGear<Flank> flanks_;
};

/// Its derivative for one modification parameter of one gear [mm/mm; parabolic_te mm rad]: the slope of the removal's derivative over the radius by a
/// central difference, which is exact for removals up to its second power.
Eigen::VectorXd tip_edge_shift_derivative(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition,
                                          Member member, ModificationParameter parameter);

}  // namespace flankwright
