#include "core/contact/gap/condition_gap.hpp"

#include <string>

#include "core/base/error.hpp"

namespace flankwright {

ConditionGap::ConditionGap(const GearPair& pair, GapModel model, const FlankCondition& condition) : pair_(pair), condition_(condition) {
  if (model == GapModel::WholeSurface) {
    surfaces_.emplace(pair, condition);
  } else {
    plane_.emplace(pair, condition);
  }
}

Gap ConditionGap::at(const std::vector<ContactPoint>& points, double line_phase) const {
  return surfaces_ ? surfaces_->at(points, line_phase) : plane_->at(points);
}

Eigen::VectorXd ConditionGap::derivative(const std::vector<ContactPoint>& points, const Gap& gap, Member member, ModificationParameter parameter,
                                         const TouchDerivative& touches) const {
  return surfaces_ ? surfaces_->derivative(points, gap, member, parameter) : gap_derivative(points, gap, touches);
}

MisalignmentSlopes ConditionGap::slopes(const std::vector<ContactPoint>& points, MisalignmentParameter parameter) const {
  if (surfaces_) {
    throw InvalidInput("misalignment." + std::string(name_of(parameter)), "a derivative",
                       "a parameter that leaves the contact points where they are");
  }
  return misalignment_slopes(pair_, points, condition_, parameter);
}

ToothGap::ToothGap(const ConditionGap& gaps, int tooth, double line_phase) : gaps_(gaps), line_phase_(line_phase) {
  if (gaps.plane_) touches_.emplace(gaps.plane_->touches(), tooth);
}

double ToothGap::at(const ContactPoint& point) const {
  return touches_ ? touches_->at(point).gap + gaps_.plane_->opened(point) : gaps_.at({point}, line_phase_).total[0];
}

}  // namespace flankwright
