#include "core/rating/edge_contact_start.hpp"

namespace flankwright {

namespace {

/// The point that is stressed most on an edge; nothing where none is.
std::optional<EdgeContactStart> on_edge(const MeshModel& model, const FlankCondition& condition, double torque) {
  const LoadedCycle cycle = analyse_cycle(model, condition, torque, {}, {}, RootStresses::Later);
  if (!cycle.usable()) return std::nullopt;
  std::optional<EdgeContactStart> found;
  double highest = 0.0;
  for (std::size_t p = 0; p < cycle.positions.size(); ++p) {
    const Eigen::VectorXd& stress = cycle.positions[p].edge_stress;
    Eigen::Index point = 0;
    if (stress.size() == 0 || !(stress.maxCoeff(&point) > highest)) continue;
    highest = stress[point];
    found = {torque, model.positions[p].points[static_cast<std::size_t>(point)].tip_edge.gear, model.positions[p].phase};
  }
  return found;
}

}  // namespace

std::optional<EdgeContactStart> edge_contact_start(const MeshModel& model, const FlankCondition& condition, double pinion_torque) {
  std::optional<EdgeContactStart> start = on_edge(model, condition, pinion_torque);
  if (!start) return std::nullopt;
  const double close = 1e-3 * pinion_torque;
  double without = 0.0;
  while (start->torque - without > close) {
    const double between = 0.5 * (without + start->torque);
    if (const auto earlier = on_edge(model, condition, between)) {
      start = earlier;
    } else {
      without = between;
    }
  }
  if (without == 0.0) start->torque = 0.0;
  return start;
}

}  // namespace flankwright
