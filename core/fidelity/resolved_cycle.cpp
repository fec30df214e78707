#include "core/fidelity/resolved_cycle.hpp"

#include <algorithm>

#include "core/fidelity/peak_reading.hpp"
#include "core/gear/both_gears.hpp"

namespace flankwright {

namespace {

/// A cycle's summary with the extremes of further positions.
void include(const MeshModel& model, const LoadedCycle& cycle, const LoadedCycle& extremes, CycleSummary& summary) {
  const Eigen::VectorXd te = cycle.transmission_error(), further = extremes.transmission_error();
  summary.te_peak_to_peak = std::max(te.maxCoeff(), further.maxCoeff()) - std::min(te.minCoeff(), further.minCoeff());
  for (const LoadedPosition& position : extremes.positions) summary.include(position);
  summary.load_factor = summary.peak_line_load / model.mean_line_load(cycle.force);
}

/// The position of either cycle at which a reading is largest.
const LoadedPosition& position_of_largest(const LoadedCycle& cycle, const LoadedCycle& extremes, const auto& reading) {
  const LoadedPosition* best = nullptr;
  for (const LoadedCycle* of : {&cycle, &extremes}) {
    for (const LoadedPosition& position : of->positions) {
      if (best == nullptr || reading(position) > reading(*best)) best = &position;
    }
  }
  return *best;
}

Eigen::Index largest_entry(const Eigen::VectorXd& values) {
  Eigen::Index index = 0;
  values.maxCoeff(&index);
  return index;
}

}  // namespace

ResolvedCycle resolve_cycle(const MeshModel& model, const LoadedCycle& cycle, const MeshWithParameters& mesh_at, const FlankCondition& condition,
                            double pinion_torque, const CycleResolving& resolving, const std::vector<MeshParameter>& parameters) {
  ResolvedCycle resolved;
  resolved.summary = summarise(model, cycle);
  if (!cycle.usable() || !(cycle.force > 0.0)) return resolved;
  const MeshAt without_parameters = [&](const std::vector<double>& phases) { return mesh_at(phases, {}); };
  if (resolving.seek_extremes) {
    const ExtremeSearch search{.first = tip_edge_passages(model, cycle), .further = resolving.further};
    resolved.extremes = locate_extremes(model, without_parameters, condition, pinion_torque, cycle, search);
  }
  if (!resolved.extremes.phases.empty()) {
    const auto mesh = std::make_shared<const MeshModel>(mesh_at(resolved.extremes.phases, parameters));
    resolved.extreme_cycle = analyse_cycle(*mesh, condition, pinion_torque, parameters);
    resolved.extreme_mesh = mesh;
    include(model, cycle, resolved.extreme_cycle, resolved.summary);
  }
  MeshModel coarse_between;
  LoadedCycle coarse;
  CyclesBetween between;
  if (resolving.coarse != nullptr) {
    if (resolving.coarse_at && resolved.extreme_mesh) {
      coarse_between = resolving.coarse_at(resolved.extremes.phases);
      coarse = analyse_cycle(coarse_between, condition, pinion_torque, {}, RootStresses::Later);
      if (coarse.usable() && resolved.extreme_cycle.usable()) between = {&resolved.extreme_cycle, &coarse};
    }
    const CycleExtremes* const sought = resolving.seek_extremes ? &resolved.extremes : nullptr;
    resolved.error_parts = estimate_errors(cycle, resolved.summary, *resolving.coarse, sought, between);
    resolved.errors = resolved.error_parts.sum(resolved.summary);
  }
  SolvedCycles of{.fine = {&model, &cycle}};
  if (resolved.extreme_mesh) of.fine_between = {resolved.extreme_mesh.get(), &resolved.extreme_cycle};
  if (resolving.coarse != nullptr && resolving.coarse_model != nullptr && resolving.coarse->usable())
    of.coarse = {resolving.coarse_model, resolving.coarse};
  if (between.coarse != nullptr) of.coarse_between = {&coarse_between, between.coarse};
  if (resolved.errors.edge_stress == 0.0 && resolved.summary.edge_stress == 0.0 && of.coarse.cycle != nullptr && resolving.seek_extremes) {
    // By positions, because finer intervals at the same positions may see no more.
    for (const Member gear : both_gears) {
      const double error = untouched_edge_error(of, resolved.extremes, gear);
      resolved.error_parts.positions.edge_stress = std::max(resolved.error_parts.positions.edge_stress, error);
    }
    resolved.errors = resolved.error_parts.sum(resolved.summary);
  }
  for (std::size_t i = 0; i < resolving.further.size(); ++i) {
    const std::vector<double>& unseen = resolved.extremes.unseen_further;
    resolved.further.push_back(
        peak_of(largest_of_points(resolving.further[i]), of, resolved.extremes.phases, i < unseen.size() ? unseen[i] : not_given));
  }
  return resolved;
}

void hold_against_finer(const SolvedCycle& cycle, const SolvedCycle& finer, const std::vector<PointReading>& further, ResolvedCycle& resolved) {
  CycleErrors& points = resolved.error_parts.points;
  points =
      point_errors_beside_finer(points, *cycle.cycle, summarise(*cycle.model, *cycle.cycle), *finer.cycle, summarise(*finer.model, *finer.cycle));
  join_edge_to_peak(resolved.summary, points);
  resolved.errors = resolved.error_parts.sum(resolved.summary);
  if (!cycle.cycle->usable() || !finer.cycle->usable()) return;
  for (std::size_t i = 0; i < std::min(further.size(), resolved.further.size()); ++i) {
    PeakReading& stated = resolved.further[i];
    stated.by_points = point_error_beside_finer(largest_of_points(further[i]), stated, cycle, finer);
  }
}

CycleGradient resolved_gradient(const MeshModel& model, const LoadedCycle& cycle, const ResolvedCycle& resolved) {
  CycleGradient gradient = summary_gradient(model, cycle, summarise(model, cycle));
  if (!resolved.extreme_mesh) return gradient;
  const LoadedCycle& extremes = resolved.extreme_cycle;
  const auto te = [](const LoadedPosition& p) { return p.load.transmission_error; };
  gradient.te_peak_to_peak = position_of_largest(cycle, extremes, te).transmission_error_derivative -
                             position_of_largest(cycle, extremes, [&](const LoadedPosition& p) { return -te(p); }).transmission_error_derivative;
  const LoadedPosition& loaded = position_of_largest(cycle, extremes, [](const LoadedPosition& p) { return p.peak_load.maxCoeff(); });
  const Eigen::Index point = largest_entry(loaded.peak_load);
  gradient.peak_line_load = loaded.peak_load_derivative.row(point);
  const Eigen::RowVectorXd mean_change = cycle.force_derivative / cycle.force - cycle.face_width_change;
  gradient.load_factor = (gradient.peak_line_load - loaded.peak_load[point] * mean_change) / model.mean_line_load(cycle.force);
  const LoadedPosition& stressed = position_of_largest(cycle, extremes, [](const LoadedPosition& p) { return p.contact_stress.maxCoeff(); });
  gradient.peak_contact_stress = stressed.contact_stress_derivative.row(largest_entry(stressed.contact_stress));
  if (gradient.edge_stress.size() > 0 && stressed.edge_stress.size() > 0) {
    const LoadedPosition& edged = position_of_largest(cycle, extremes, [](const LoadedPosition& p) { return p.edge_stress.maxCoeff(); });
    gradient.edge_stress = edged.edge_stress_derivative.row(largest_entry(edged.edge_stress));
    gradient.tip_edge_share =
        position_of_largest(cycle, extremes, [](const LoadedPosition& p) { return p.tip_edge_share; }).tip_edge_share_derivative;
  }
  return gradient;
}

}  // namespace flankwright
