#include "core/load/cycle/mesh_parameter.hpp"

namespace flankwright {

ParameterSlopes parameter_slopes(const MeshModel& model, const MeshPosition& at, const ConditionGap& gaps, const Gap& gap,
                                 const std::vector<MeshParameter>& parameters, const std::vector<Eigen::Index>& on_edges) {
  const auto m = static_cast<Eigen::Index>(parameters.size());
  ParameterSlopes slopes{Eigen::MatrixXd::Zero(std::ssize(at.points), m), {}, Eigen::RowVectorXd::Zero(m)};
  if (!on_edges.empty()) slopes.edge = Eigen::MatrixXd::Zero(std::ssize(at.points), m);
  for (Eigen::Index p = 0; p < m; ++p) {
    const MeshParameter& which = parameters[static_cast<std::size_t>(p)];
    if (const auto* gear = std::get_if<GearParameter>(&which)) {
      slopes.gap.col(p) = gaps.derivative(at.points, gap, gear->member, gear->parameter);
      if (on_edges.empty()) continue;
      const TouchDerivative touches(model.pair, gaps.condition(), gear->member, gear->parameter);
      for (const Eigen::Index i : on_edges) {
        const auto k = static_cast<std::size_t>(i);
        slopes.edge(i, p) = touches.of_edge(at.points[k], gap.touches[k]);
      }
    } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&which)) {
      if (moves_mesh(gaps.model(), which)) continue;
      const MisalignmentSlopes by = gaps.slopes(at.points, *misalignment);
      slopes.gap.col(p) = by.gap;
      for (const Eigen::Index i : on_edges) slopes.edge(i, p) = by.edge[i];
    } else {
      slopes.force[p] = model.normal_force(1.0);
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
