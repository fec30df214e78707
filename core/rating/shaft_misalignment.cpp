#include "core/rating/shaft_misalignment.hpp"

namespace flankwright {

ShaftPair shafts_under(const ShaftPair& shafts, const MeshModel& model, double pinion_torque) {
  return model.placement.other_flanks ? shafts.reversed().at_torque(pinion_torque) : shafts.at_torque(pinion_torque);
}

std::vector<PerGear<ShaftMotion>> shaft_motions(const ShaftPair& shafts, const MeshModel& model, const LoadedCycle& cycle) {
  std::vector<PerGear<ShaftMotion>> motions(cycle.positions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const LoadDistribution& load = cycle.positions[i].load;
    if (!load.usable()) continue;
    const MeshPosition& at = model.positions[i];
    const Eigen::VectorXd forces = at.weight.cwiseProduct(load.line_load);
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (shafts.has_shaft(m)) motions[i][m] = shafts.motion(m, at.points, forces, model.axial_offset);
    }
  }
  return motions;
}

double opened_by(const ShaftPair& shafts, const PerGear<ShaftMotion>& motions) {
  double sum = 0.0;
  for (const Member m : {Member::Pinion, Member::Wheel}) sum += shafts.has_shaft(m) ? motions[m].misalignment : 0.0;
  return sum;
}

double shaft_misalignment(const ShaftPair& shafts, const std::vector<PerGear<ShaftMotion>>& motions) {
  double sum = 0.0;
  for (const PerGear<ShaftMotion>& at : motions) sum += opened_by(shafts, at);
  return sum / static_cast<double>(motions.size());
}

double rim_opening(const PairRimMotion& rims, const MeshModel& model, double force) {
  double sum = 0.0;
  for (const MeshPosition& at : model.positions) {
    if (at.points.empty()) continue;
    const Eigen::VectorXd forces = at.weight * (force / at.weight.sum());
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (rims.has_rim(m)) sum += rims.motion(m, at.points, forces, model.axial_offset).misalignment_at_teeth;
    }
  }
  return sum / static_cast<double>(model.positions.size());
}

}  // namespace flankwright
