#include "core/fidelity/resolved_analysis.hpp"

namespace flankwright {

namespace {

struct Parts {
  double points, positions;  ///< headline_error() of each [-]
};

Parts parts_of(const ResolvedCycle& resolved, const LoadedCycle& cycle) {
  const auto part = [&](const CycleErrors& errors) { return headline_error(errors, resolved.summary, cycle); };
  return {part(resolved.error_parts.points), part(resolved.error_parts.positions)};
}

}  // namespace

bool mostly_by_points(const ResolvedCycle& resolved, const LoadedCycle& cycle) {
  const Parts parts = parts_of(resolved, cycle);
  return parts.points >= parts.positions;
}

bool refine(AutomaticResolution& from, const ResolvedCycle& resolved, const LoadedCycle& cycle) {
  const bool more_intervals = from.choose_intervals && 2 * from.intervals <= from.most_intervals;
  const bool more_positions = from.choose_positions && 2 * from.positions <= from.most_positions;
  const Parts parts = parts_of(resolved, cycle);
  const bool positions_are_in_vain = !more_intervals && parts.points > from.accuracy && parts.positions <= from.accuracy;
  const bool intervals_are_in_vain = !more_positions && parts.positions > from.accuracy && parts.points <= from.accuracy;
  if (positions_are_in_vain || intervals_are_in_vain) return false;
  if (more_intervals && (!more_positions || parts.points >= parts.positions)) {
    from.intervals *= 2;
    return true;
  }
  if (more_positions) from.positions *= 2;
  return more_positions;
}

ResolvedAnalysis analyse_resolved(const MeshOfResolution& mesh_for, const FlankCondition& condition, double pinion_torque,
                                  AutomaticResolution automatic) {
  ResolvedAnalysis made;
  do {
    const Quadrature quadrature{QuadratureRule::Graded, automatic.intervals}, half{QuadratureRule::Graded, automatic.intervals / 2};
    made.resolution = {quadrature, equally_spaced_phases(automatic.positions)};
    made.model = mesh_for(made.resolution);
    made.cycle = analyse_cycle(made.model, condition, pinion_torque);
    const LoadedCycle coarse = analyse_cycle(mesh_for({half, coarse_phases(made.resolution.phases)}), condition, pinion_torque);
    const auto mesh_at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) { return mesh_for({quadrature, phases}); };
    const MeshAt coarse_at = [&](const std::vector<double>& phases) { return mesh_for({half, phases}); };
    made.resolved = resolve_cycle(made.model, made.cycle, mesh_at, condition, pinion_torque, {.coarse = &coarse, .coarse_at = coarse_at});
    made.error = headline_error(made.resolved.errors, made.resolved.summary, made.cycle);
  } while (made.error > automatic.accuracy && refine(automatic, made.resolved, made.cycle));
  return made;
}

}  // namespace flankwright
