#pragma once

#include <optional>

#include "core/contact/assembly/wheel_displacement.hpp"
#include "core/contact/gap/flank_touch_search.hpp"
#include "core/contact/gap/gap.hpp"

namespace flankwright {

/// Gap of unloaded flanks at each contact point, normal to the flank, at the angle at which the undisturbed pair would touch [mm]:
///
///     g = touch + misalignment
///
/// The touch is that of both flanks with their clearance and deviations in the section of the point, see FlankTouchSearch; it moves along the profile
/// with the wheel. Misalignment is the wheel's displacement along the pinion's outward normal, first order in the angles; a changed pinion helicoid (lead
/// or pressure-angle error) enters by the exact angle between the changed and the nominal flank. Both are those of the plane of action. Negative where
/// metal is added or the wheel is pushed into the pinion.
class PlaneOfActionGap {
 public:
  /// What is constant over the positions is computed once.
  /// @param pair  must outlive this
  PlaneOfActionGap(const GearPair& pair, const FlankCondition& condition);
  Gap at(const std::vector<ContactPoint>& points) const;

  const FlankTouchSearch& touches() const { return touches_; }
  /// What misalignment opens at a point.
  double opened(const ContactPoint& point) const;

 private:
  const GearPair& pair_;
  WheelDisplacement displacement_;
  FlankTouchSearch touches_;
  struct Helicoids {
    Flank nominal, changed;
  };
  std::optional<Helicoids> pinion_;  ///< nothing: the pinion's is the nominal one
};

/// The same at the points of one position.
Gap plane_of_action_gap(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition);

/// dg/dp at each point for one modification parameter of one gear [mm/mm; parabolic_te mm rad], exact.
/// @param gap      as plane_of_action_gap() gave it
/// @param touches  of the parameter
Eigen::VectorXd gap_derivative(const std::vector<ContactPoint>& points, const Gap& gap, const TouchDerivative& touches);

}  // namespace flankwright
