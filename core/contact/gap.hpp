#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/contact/contact_points.hpp"
#include "core/contact/misalignment.hpp"
#include "core/flank/removal.hpp"

namespace flankwright {

/// What of a working condition shapes the gap between the flanks.
struct FlankCondition {
  Modification pinion_modification, wheel_modification;
  ManufacturingError pinion_error, wheel_error;
  Misalignment misalignment;

  const Modification& modification(Member m) const { return m == Member::Pinion ? pinion_modification : wheel_modification; }
  const ManufacturingError& error(Member m) const { return m == Member::Pinion ? pinion_error : wheel_error; }
  bool operator==(const FlankCondition&) const = default;
};

/// Gap of unloaded flanks at each contact point, normal to the flank, at the angle at which the undisturbed pair would touch [mm]:
///
///     g = c_n + cos(beta_b) sum over both gears of D (see Flank) + misalignment
///
/// Contact stays where the undisturbed flanks would touch (plane of action). Misalignment is the wheel's displacement
/// along the pinion's outward normal, first order in the angles; a changed pinion helicoid (lead or pressure-angle error) enters by the
/// exact angle between the changed and the nominal flank. Negative where metal is added or the wheel is pushed into the pinion.
struct Gap {
  Eigen::VectorXd total;     ///< g [mm]
  Eigen::VectorXd error;     ///< the part that is not clearance, sign of Haddad's delta_e: metal added is positive [mm]
};
Gap plane_of_action_gap(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition);

/// dg/dp at each point for one modification parameter of one gear [mm/mm; parabolic_te mm rad], exact.
Eigen::VectorXd gap_derivative(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition,
                               Member member, ModificationParameter parameter);

}  // namespace flankwright
