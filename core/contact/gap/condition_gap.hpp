#pragma once

#include <optional>
#include <vector>

#include "core/contact/gap/misalignment_gap.hpp"
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
  Eigen::VectorXd derivative(const std::vector<ContactPoint>& points, const Gap& gap, Member member, ModificationParameter parameter) const;

  /// By one number of the misalignment that leaves the points where they are.
  /// @throws InvalidInput  where it moves them: in the plane of action the axial offset, over the whole surface any
  MisalignmentSlopes slopes(const std::vector<ContactPoint>& points, MisalignmentParameter parameter) const;

 private:
  const GearPair& pair_;
  const FlankCondition& condition_;
  std::optional<SurfaceGap> surfaces_;  ///< WholeSurface only
};

}  // namespace flankwright
