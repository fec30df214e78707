#include "core/load/cycle/mesh_parameter.hpp"

#include <algorithm>

namespace flankwright {

ParameterSlopes parameter_slopes(const MeshModel& model, const MeshPosition& at, const ConditionGap& gaps, const Gap& gap,
                                 const std::vector<MeshParameter>& parameters) {
  const auto m = static_cast<Eigen::Index>(parameters.size());
  ParameterSlopes slopes{Eigen::MatrixXd::Zero(std::ssize(at.points), m), {}, Eigen::RowVectorXd::Zero(m)};
  const bool edges =
      model.effects.has("edge_contact") && std::ranges::any_of(at.points, [](const ContactPoint& p) { return p.tip_edge.radius > 0.0; });
  if (edges) slopes.edge = Eigen::MatrixXd::Zero(std::ssize(at.points), m);
  for (Eigen::Index p = 0; p < m; ++p) {
    const MeshParameter& which = parameters[static_cast<std::size_t>(p)];
    if (const auto* gear = std::get_if<GearParameter>(&which)) {
      slopes.gap.col(p) = gaps.derivative(at.points, gap, gear->member, gear->parameter);
      if (edges) slopes.edge.col(p) = tip_edge_shift_derivative(model.pair, at.points, gaps.condition(), gear->member, gear->parameter);
    } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&which)) {
      if (!moves_mesh(gaps.model(), which)) slopes.gap.col(p) = gaps.derivative(at.points, *misalignment);
    } else {
      slopes.force[p] = model.normal_force(1.0);
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
