#include "core/load/cycle/mesh_parameter.hpp"

namespace flankwright {

ParameterSlopes parameter_slopes(const MeshModel& model, const MeshPosition& at, const ConditionGap& gaps, const Gap& gap,
                                 const std::vector<MeshParameter>& parameters, const std::vector<Eigen::Index>& on_edges) {
  const auto m = static_cast<Eigen::Index>(parameters.size());
  ParameterSlopes slopes{Eigen::MatrixXd::Zero(std::ssize(at.points), m), {}, Eigen::RowVectorXd::Zero(m)};
  std::vector<ContactPoint> edged;
  for (const Eigen::Index i : on_edges) edged.push_back(at.points[static_cast<std::size_t>(i)]);
  if (!edged.empty()) slopes.edge = Eigen::MatrixXd::Zero(std::ssize(at.points), m);
  for (Eigen::Index p = 0; p < m; ++p) {
    const MeshParameter& which = parameters[static_cast<std::size_t>(p)];
    if (const auto* gear = std::get_if<GearParameter>(&which)) {
      slopes.gap.col(p) = gaps.derivative(at.points, gap, gear->member, gear->parameter);
      if (!edged.empty()) slopes.edge(on_edges, p) = tip_edge_shift_derivative(model.pair, edged, gaps.condition(), gear->member, gear->parameter);
    } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&which)) {
      if (!moves_mesh(gaps.model(), which)) slopes.gap.col(p) = gaps.derivative(at.points, *misalignment);
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
