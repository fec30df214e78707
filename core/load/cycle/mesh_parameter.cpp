#include "core/load/cycle/mesh_parameter.hpp"

#include "core/contact/gap/condition_gap.hpp"

namespace flankwright {

ConditionSlopes::ConditionSlopes(const MeshModel& model, const ConditionGap& gaps, const std::vector<MeshParameter>& parameters)
    : model_(model), gaps_(gaps), parameters_(parameters), touches_(parameters.size()) {
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto* gear = std::get_if<GearParameter>(&parameters[p]);
    if (gear != nullptr) touches_[p].emplace(model.pair, gaps.condition(), gear->member, gear->parameter);
  }
}

ParameterSlopes ConditionSlopes::at(const MeshPosition& at, const Gap& gap, const std::vector<Eigen::Index>& on_edges) const {
  const auto m = static_cast<Eigen::Index>(parameters_.size());
  ParameterSlopes slopes{Eigen::MatrixXd::Zero(std::ssize(at.points), m), {}, Eigen::RowVectorXd::Zero(m)};
  if (!on_edges.empty()) slopes.edge = Eigen::MatrixXd::Zero(std::ssize(at.points), m);
  for (Eigen::Index p = 0; p < m; ++p) {
    const MeshParameter& which = parameters_[static_cast<std::size_t>(p)];
    if (const auto* gear = std::get_if<GearParameter>(&which)) {
      const TouchDerivative& touches = *touches_[static_cast<std::size_t>(p)];
      slopes.gap.col(p) = gaps_.derivative(at.points, gap, gear->member, gear->parameter, touches);
      for (const Eigen::Index i : on_edges) {
        const auto k = static_cast<std::size_t>(i);
        slopes.edge(i, p) = touches.of_edge(at.points[k], gap.touches[k]);
      }
    } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&which)) {
      if (moves_mesh(gaps_.model(), which)) continue;
      const MisalignmentSlopes by = gaps_.slopes(at.points, *misalignment);
      slopes.gap.col(p) = by.gap;
      for (const Eigen::Index i : on_edges) slopes.edge(i, p) = by.edge[i];
    } else {
      slopes.force[p] = model_.normal_force(1.0);
      if (at.outside.by_force.size() > 0) slopes.gap.col(p) = slopes.force[p] * at.outside.by_force;
    }
  }
  return slopes;
}

bool moves_mesh(GapModel gap, const MeshParameter& parameter) {
  const auto* misalignment = std::get_if<MisalignmentParameter>(&parameter);
  if (!misalignment) return false;
  Misalignment unit;
  unit.*(*misalignment) = 1.0;
  return MeshPlacement::of(gap, unit) != MeshPlacement::of(gap, {});
}

std::vector<Eigen::Index> moving_among(GapModel gap, const std::vector<MeshParameter>& parameters) {
  std::vector<Eigen::Index> found;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (moves_mesh(gap, parameters[p])) found.push_back(static_cast<Eigen::Index>(p));
  }
  return found;
}

}  // namespace flankwright
