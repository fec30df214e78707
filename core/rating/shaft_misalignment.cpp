#include "core/rating/shaft_misalignment.hpp"

namespace flankwright {

ShaftPair shafts_under(const ShaftPair& shafts, const MeshModel& model, double pinion_torque) {
  return model.placement.other_flanks ? shafts.reversed().at_torque(pinion_torque) : shafts.at_torque(pinion_torque);
}

PerGear<ShaftMotion> shaft_motions(const ShaftPair& shafts, const MeshModel& model, const LoadedCycle& cycle, std::size_t position) {
  PerGear<ShaftMotion> motions;
  const LoadDistribution& load = cycle.positions[position].load;
  if (!load.usable()) return motions;
  const MeshPosition& at = model.positions[position];
  const Eigen::VectorXd forces = at.weight.cwiseProduct(load.line_load);
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (shafts.has_shaft(m)) motions[m] = shafts.motion(m, at.points, forces, model.axial_offset);
  }
  return motions;
}

double opened_by(const ShaftPair& shafts, const PerGear<ShaftMotion>& motions) {
  double sum = 0.0;
  for (const Member m : {Member::Pinion, Member::Wheel}) sum += shafts.has_shaft(m) ? motions[m].misalignment : 0.0;
  return sum;
}

double shaft_misalignment(const ShaftPair& shafts, const MeshModel& model, const LoadedCycle& cycle) {
  double sum = 0.0;
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) sum += opened_by(shafts, shaft_motions(shafts, model, cycle, i));
  return sum / static_cast<double>(cycle.positions.size());
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
