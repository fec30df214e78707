#include "core/load/mesh_parameter.hpp"

namespace flankwright {

ParameterSlopes parameter_slopes(const MeshModel& model, const MeshPosition& at, const ConditionGap& gaps, const Gap& gap,
                                 const std::vector<MeshParameter>& parameters) {
  const auto m = static_cast<Eigen::Index>(parameters.size());
  ParameterSlopes slopes{Eigen::MatrixXd::Zero(std::ssize(at.points), m), Eigen::RowVectorXd::Zero(m)};
  for (Eigen::Index p = 0; p < m; ++p) {
    const MeshParameter& which = parameters[static_cast<std::size_t>(p)];
    if (const auto* gear = std::get_if<GearParameter>(&which)) {
      slopes.gap.col(p) = gaps.derivative(at.points, gap, gear->member, gear->parameter);
    } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&which)) {
      if (*misalignment != &Misalignment::axial_offset) slopes.gap.col(p) = gaps.derivative(at.points, at.phase, gap, *misalignment);
    } else {
      slopes.force[p] = model.normal_force(1.0);
    }
  }
  return slopes;
}

std::vector<Eigen::Index> axial_offsets_among(const std::vector<MeshParameter>& parameters) {
  std::vector<Eigen::Index> found;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto* misalignment = std::get_if<MisalignmentParameter>(&parameters[p]);
    if (misalignment && *misalignment == &Misalignment::axial_offset) found.push_back(static_cast<Eigen::Index>(p));
  }
  return found;
}

}  // namespace flankwright
