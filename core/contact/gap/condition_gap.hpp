#pragma once

#include <optional>
#include <vector>

#include "core/contact/gap/gap_model.hpp"
#include "core/contact/gap/misalignment_gap.hpp"
#include "core/contact/gap/plane_of_action_gap.hpp"
#include "core/contact/gap/surface_gap.hpp"

namespace flankwright {

/// The gap of one working condition by either model, prepared once for all mesh positions.
class ConditionGap {
 public:
  /// @param pair, condition  must outlive this
  /// @throws InvalidInput  as SurfaceGap
  ConditionGap(const GearPair& pair, GapModel model, const FlankCondition& condition);

  const FlankCondition& condition() const { return condition_; }
  GapModel model() const { return surfaces_ ? GapModel::WholeSurface : GapModel::PlaneOfAction; }

  /// @param line_phase  of tooth pair 0, as the points were made for
  Gap at(const std::vector<ContactPoint>& points, double line_phase) const;

  /// dg/dp at each point for one modification parameter of one gear [mm/mm; parabolic_te mm rad], exact.
  /// @param gap  as at() gave it for these points
  /// @param touches  of the same parameter
  Eigen::VectorXd derivative(const std::vector<ContactPoint>& points, const Gap& gap, Member member, ModificationParameter parameter,
                             const TouchDerivative& touches) const;
  Eigen::VectorXd derivative(const std::vector<ContactPoint>& points, const Gap& gap, Member member, ModificationParameter parameter) const {
    return derivative(points, gap, member, parameter, {pair_, condition_, member, parameter});
  }

  /// By one number of the misalignment that leaves the points where they are.
  /// @throws InvalidInput  where it moves them: in the plane of action the axial offset, over the whole surface any
  MisalignmentSlopes slopes(const std::vector<ContactPoint>& points, MisalignmentParameter parameter) const;

 private:
  friend class ToothGap;
  const GearPair& pair_;
  const FlankCondition& condition_;
  std::optional<PlaneOfActionGap> plane_;  ///< either this
  std::optional<SurfaceGap> surfaces_;     ///< or this, WholeSurface
};

/// ConditionGap::at() for one point after another of one tooth pair at one position.
class ToothGap {
 public:
  /// @param gaps  must outlive this
  ToothGap(const ConditionGap& gaps, int tooth, double line_phase);
  /// Gap::total [mm]
  double at(const ContactPoint& point) const;

 private:
  const ConditionGap& gaps_;
  double line_phase_;
  std::optional<FlankTouchSearch::OnTooth> touches_;  ///< in the plane of action
};

}  // namespace flankwright
