#include "core/contact/gap/condition_gap.hpp"

#include <string>

#include "core/base/error.hpp"

namespace flankwright {

ConditionGap::ConditionGap(const GearPair& pair, GapModel model, const FlankCondition& condition) : pair_(pair), condition_(condition) {
  if (model == GapModel::WholeSurface) surfaces_.emplace(pair, condition);
}

Gap ConditionGap::at(const std::vector<ContactPoint>& points, double line_phase) const {
  return surfaces_ ? surfaces_->at(points, line_phase) : plane_of_action_gap(pair_, points, condition_);
}

Eigen::VectorXd ConditionGap::derivative(const std::vector<ContactPoint>& points, const Gap& gap, Member member,
                                         ModificationParameter parameter) const {
  return surfaces_ ? surfaces_->derivative(points, gap, member, parameter) : gap_derivative(pair_, points, gap, condition_, member, parameter);
}

MisalignmentSlopes ConditionGap::slopes(const std::vector<ContactPoint>& points, MisalignmentParameter parameter) const {
  if (surfaces_) {
    throw InvalidInput("misalignment." + std::string(name_of(parameter)), "a derivative",
                       "a parameter that leaves the contact points where they are");
  }
  return misalignment_slopes(pair_, points, condition_, parameter);
}

}  // namespace flankwright
