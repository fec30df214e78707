#include "core/load/cycle/mesh_cycle.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "core/contact/gap/condition_gap.hpp"
#include "core/contact/unloaded/transmission_error.hpp"
#include "core/load/solve/load_solver.hpp"
#include "core/load/cycle/contact_stress.hpp"
#include "core/load/cycle/line_crest.hpp"
#include "core/load/cycle/load_start.hpp"
#include "core/load/cycle/mesh_motion.hpp"

namespace flankwright {

namespace {

constexpr double micrometre = units::um, unlimited = std::numeric_limits<double>::infinity();

/// Stresses and the largest loads with their derivatives.
/// @param slopes  of the condition at the position
void fill_peaks(const LoadedLines& lines, const ParameterSlopes& slopes, const ConditionSlopes& condition, const Eigen::RowVectorXd& force_derivative,
                LoadedPosition& position) {
  const Eigen::VectorXd& w = position.load.line_load;
  const Eigen::MatrixXd& by_load = position.line_load_derivative;
  const bool edges = std::ranges::any_of(lines.laws, [](const ContactLaw& law) { return law.edge() && law.edge()->radius > 0.0; });
  position.contact_stress = Eigen::VectorXd::Zero(w.size());
  position.contact_stress_derivative = Eigen::MatrixXd::Zero(w.size(), by_load.cols());
  position.peak_load = w;
  position.peak_load_derivative = by_load;
  if (edges) position.edge_stress = position.contact_stress;
  if (edges) position.edge_stress_derivative = position.contact_stress_derivative;
  const std::vector<LineCrest> crests = line_crests(lines);
  const CrestSlopes by_crest = crest_slopes(lines, crests, {by_load, slopes.gap}, condition);
  const PlaceSlopes by{by_load, slopes.edge, by_crest};
  const std::vector<PointPeaks> peaks = point_peaks(lines.model, lines.at, lines.laws, w, crests);
  double on_edges = 0.0;
  Eigen::RowVectorXd on_edges_derivative = Eigen::RowVectorXd::Zero(by_load.cols());
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    if (w[i] <= 0.0) continue;
    const auto& [stress, on_edge, load, edge_load] = peaks[static_cast<std::size_t>(i)];
    position.contact_stress[i] = stress.value;
    position.contact_stress_derivative.row(i) = stress.derivative(by);
    position.peak_load[i] = load.value;
    if (load.value > w[i]) position.peak_load_derivative.row(i) = load.derivative(by);
    if (!edges || on_edge.value == 0.0) continue;
    position.edge_stress[i] = on_edge.value;
    position.edge_stress_derivative.row(i) = on_edge.derivative(by);
    on_edges += lines.at.weight[i] * edge_load.load;
    on_edges_derivative += lines.at.weight[i] * edge_load.slope * by_load.row(i);
    if (by.edge.size() > 0) on_edges_derivative += lines.at.weight[i] * edge_load.by_edge * by.edge.row(i);
  }
  if (!edges) return;
  const double force = lines.force;
  position.tip_edge_share = force > 0.0 ? on_edges / force : 0.0;
  position.tip_edge_share_derivative = on_edges_derivative;
  if (force > 0.0) position.tip_edge_share_derivative = (on_edges_derivative - position.tip_edge_share * force_derivative) / force;
}

std::vector<Eigen::Index> reaching_edges(const std::vector<ContactLaw>& laws, const Eigen::VectorXd& line_load) {
  std::vector<Eigen::Index> found;
  for (Eigen::Index i = 0; i < std::ssize(laws); ++i) {
    if (laws[static_cast<std::size_t>(i)].reaches_edge(line_load[i])) found.push_back(i);
  }
  return found;
}

/// The line load of a point that carries the whole force [N/mm]; 0 of points whose gap exceeds the least one by more than an approach.
Eigen::VectorXd load_bounds(const MeshPosition& at, const Gap& gap, double force, double approach) {
  Eigen::VectorXd most = force * at.weight.cwiseInverse();
  const double limit = gap.total.minCoeff() + approach;
  for (Eigen::Index i = 0; i < most.size(); ++i) {
    if (gap.total[i] > limit) most[i] = 0.0;
  }
  return most;
}

bool carries_beyond(const LoadedPosition& position, double approach) {
  const double limit = position.gap.total.minCoeff() + approach;
  return ((position.gap.total.array() > limit) && (position.load.line_load.array() > 0.0)).any();
}

void raise(RootStressPeak& peak, const RootStressPeak& other) {
  const double tangent = std::fmax(peak.tangent_stress, other.tangent_stress);
  if (std::isgreater(other.stress, peak.stress) || std::isnan(peak.stress)) peak = other;  // quiet where stresses are not computed
  peak.tangent_stress = tangent;
}

/// The slopes of a parameter that moves the mesh, and its index.
struct MovedMesh {
  Eigen::Index column;
  MeshSlope slope;
};

/// Without force flanks touch at the nearest point, and move with it.
void fill_derivatives(const LoadProblemView& problem, const LoadSolver& solver, const std::vector<MovedMesh>& moved,
                      const std::vector<Eigen::Index>& on_edges, ParameterSlopes slopes, LoadedPosition& position) {
  const Eigen::Index n = problem.gap.size(), m = slopes.gap.cols();
  for (const auto& [p, slope] : moved) slopes.gap.col(p) = slope.gap;
  position.line_load_derivative = Eigen::MatrixXd::Zero(n, m);
  position.approach_derivative = Eigen::RowVectorXd::Zero(m);
  Eigen::Index nearest = 0;
  problem.gap.minCoeff(&nearest);
  const Eigen::RowVectorXd nearest_slope = slopes.gap.row(nearest);
  position.transmission_error_derivative = nearest_slope;
  position.gap_derivative = slopes.gap;
  if (m == 0 || problem.force == 0.0) return;
  // At held loads a law yields more or less as its edge moves, as if the gap did.
  for (const Eigen::Index i : on_edges) {
    slopes.gap.row(i) += problem.laws[static_cast<std::size_t>(i)].edge_slope(position.load.line_load[i]) * slopes.edge.row(i);
  }
  for (const auto& [p, slope] : moved) {
    slopes.gap.col(p) += slope.deflection;
    slopes.force[p] -= slope.carried_force;
  }
  auto derivatives = solver.sensitivity().with(slopes.gap, slopes.force);
  position.line_load_derivative = std::move(derivatives.line_load);
  position.transmission_error_derivative = std::move(derivatives.transmission_error);
  position.approach_derivative = position.transmission_error_derivative - nearest_slope;
}

/// The remainder at held loads: contact stress follows curvature and edges, root stress the motion of the points.
void add_moved_places(const std::vector<MovedMesh>& moved, double force, LoadedPosition& position) {
  position.root_influence_derivative = Eigen::MatrixXd::Zero(moved.front().slope.root_components.size(), position.line_load_derivative.cols());
  for (const auto& [p, slope] : moved) {
    position.contact_stress_derivative.col(p) += slope.contact_stress;
    position.peak_load_derivative.col(p) += slope.peak_load;
    if (position.edge_stress.size() > 0) {
      position.edge_stress_derivative.col(p) += slope.edge_stress;
      if (force > 0.0) position.tip_edge_share_derivative[p] += slope.edge_force / force;
    }
    position.root_influence_derivative.col(p) = slope.root_components;
  }
}

/// Without root stress.
/// @param which  positions, rising; the others stay as they begin
LoadedCycle analyse(const MeshModel& model, std::span<const std::size_t> which, const FlankCondition& condition, double pinion_torque,
                    const std::vector<MeshParameter>& parameters, const LoadedCycle* earlier) {
  LoadedCycle cycle;
  cycle.force = model.normal_force(pinion_torque);
  cycle.closes = !teeth_differ(condition.error.pinion) && !teeth_differ(condition.error.wheel);
  cycle.positions.resize(model.positions.size());
  const double cos_base_helix = std::cos(model.pair.base_helix_angle);
  const ConditionGap gaps(model.pair, model.placement.gap, condition);
  const PairReliefStarts starts = relief_starts(model.pair, condition);
  const ConditionSlopes condition_slopes(model, gaps, parameters);
  const std::vector<Eigen::Index> moving = moving_among(model.placement.gap, parameters);
  std::deque<MeshSlopes> slopes_of;  // of each of them
  cycle.face_width_change = Eigen::RowVectorXd::Zero(std::ssize(parameters));
  for (const Eigen::Index p : moving) {
    const MeshSlopes& by = slopes_of.emplace_back(model, condition, std::get<MisalignmentParameter>(parameters[static_cast<std::size_t>(p)]));
    cycle.face_width_change[p] = by.face_width() / model.face_width;
  }
  // Twice the approach of the position before: points further apart are taken to carry nothing until they are found to.
  double likely_approach = unlimited;
  LoadSolver solver;
  for (const std::size_t i : which) {
    const MeshPosition& at = model.positions[i];
    LoadedPosition& position = cycle.positions[i];
    position.phase = at.phase;
    position.gap = gap_under(at, gaps, cycle.force);
    const Eigen::VectorXd start = starting_loads(model, cycle, i, earlier);
    std::vector<ContactLaw> moved_edges;  // empty: those of the position hold
    const auto problem_of = [&]() -> LoadProblemView {
      return {at.influence, at.weight, position.gap.total, moved_edges.empty() ? at.laws : moved_edges, cycle.force};
    };
    const bool has_edges = std::ranges::any_of(at.laws, [](const ContactLaw& law) { return law.edge().has_value(); });
    if (has_edges) moved_edges = laws_with_moved_edges(at, position.gap, load_bounds(at, position.gap, cycle.force, likely_approach));
    position.load = solver.solve(problem_of(), {}, start);
    if (has_edges && position.load.usable() && carries_beyond(position, likely_approach)) {
      moved_edges = laws_with_moved_edges(at, position.gap, load_bounds(at, position.gap, cycle.force, unlimited));
      position.load = solver.solve(problem_of(), {}, start);
    }
    const LoadProblemView problem = problem_of();
    const std::vector<ContactLaw>& laws = problem.laws;
    if (!position.load.usable()) {
      ++cycle.failures;
      continue;
    }
    const std::vector<Eigen::Index> on_edges = reaching_edges(laws, position.load.line_load);
    const ParameterSlopes slopes = condition_slopes.at(at, position.gap, on_edges);
    cycle.force_derivative = slopes.force;
    std::vector<MovedMesh> moved;
    for (std::size_t k = 0; k < moving.size(); ++k) moved.push_back({moving[k], slopes_of[k].at(i, position.load)});
    fill_derivatives(problem, solver, moved, on_edges, slopes, position);
    const LoadDistribution& load = position.load;
    const LoadedLines lines{model, at, gaps, starts, position.gap, cycle.force, laws, load.line_load, load.structural_deflection};
    fill_peaks(lines, slopes, condition_slopes, cycle.force_derivative, position);
    if (!moved.empty()) add_moved_places(moved, cycle.force, position);
    position.shaft_deflection = at.shaft_compliance * cycle.force;
    const double approach = position.approach();
    likely_approach = 2.0 * approach;
    position.stiffness = cycle.force / model.face_width * cos_base_helix * cos_base_helix / (approach / micrometre);
  }
  return cycle;
}

/// Takes the positions from `middle` on.
void add_half(LoadedCycle&& half, std::size_t middle, LoadedCycle& cycle) {
  for (std::size_t i = middle; i < cycle.positions.size(); ++i) cycle.positions[i] = std::move(half.positions[i]);
  cycle.failures += half.failures;
  if (half.force_derivative.size() > 0) cycle.force_derivative = std::move(half.force_derivative);
}

}  // namespace

LoadedCycle analyse_cycle(const MeshModel& model, const FlankCondition& condition, double pinion_torque, const std::vector<MeshParameter>& parameters,
                          RootStresses root_stresses, const LoadedCycle* earlier, const ForEachIndex& for_each) {
  std::vector<std::size_t> all(model.positions.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const bool in_halves = for_each && earlier != nullptr && all.size() >= 2;
  const std::size_t middle = in_halves ? all.size() / 2 : all.size();
  std::array<LoadedCycle, 2> parts;
  run_for_each(for_each, in_halves ? 2 : 1, [&](std::size_t part) {
    const std::span of = part == 0 ? std::span(all).first(middle) : std::span(all).subspan(middle);
    parts[part] = analyse(model, of, condition, pinion_torque, parameters, earlier);
  });
  LoadedCycle& cycle = parts[0];
  if (in_halves) add_half(std::move(parts[1]), middle, cycle);
  if (root_stresses == RootStresses::WithLoads) add_root_stress(model, cycle);
  return std::move(cycle);
}

LoadedCycle analyse_positions(const MeshModel& model, std::span<const std::size_t> positions, const FlankCondition& condition, double pinion_torque,
                              RootStresses root_stresses, const LoadedCycle* earlier) {
  assert(std::ranges::is_sorted(positions) && (positions.empty() || positions.back() < model.positions.size()));
  LoadedCycle cycle = analyse(model, positions, condition, pinion_torque, {}, earlier);
  if (root_stresses == RootStresses::WithLoads) add_root_stress(model, cycle);
  return cycle;
}

namespace {

/// Components are linear in the forces a w; principal stresses are their largest component.
Eigen::VectorXd principal_stresses(const Eigen::VectorXd& components) {
  Eigen::VectorXd stresses(components.size() / 3);
  for (Eigen::Index i = 0; i < stresses.size(); ++i) stresses[i] = largest_principal(components.segment<3>(3 * i)).value;
  return stresses;
}

}  // namespace

Eigen::VectorXd root_stresses(const MeshPosition& at, const LoadDistribution& load) {
  return principal_stresses(at.root_stress.components(at.weight.cwiseProduct(load.line_load)));
}

void add_root_stress(const MeshModel& model, LoadedCycle& cycle) {
  std::vector<const RootStressInfluence*> influences;
  std::vector<Eigen::VectorXd> forces;
  std::vector<LoadedPosition*> loaded;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const MeshPosition& at = model.positions[i];
    LoadedPosition& position = cycle.positions[i];
    if (at.root_stress.stations.empty() || !position.load.usable()) continue;
    influences.push_back(&at.root_stress);
    forces.push_back(at.weight.cwiseProduct(position.load.line_load));
    loaded.push_back(&position);
  }
  const std::vector<Eigen::VectorXd> components = RootStressInfluence::components(influences, forces);
  for (std::size_t k = 0; k < loaded.size(); ++k) loaded[k]->root_stress = principal_stresses(components[k]);
}

Eigen::RowVectorXd root_stress_derivative(const MeshPosition& at, const LoadedPosition& position, Eigen::Index station) {
  // The direction of a principal stress is held at its optimum.
  const auto influence = at.root_stress.components_of(station);
  const PrincipalStress principal = largest_principal(influence * at.weight.cwiseProduct(position.load.line_load));
  Eigen::MatrixXd components = influence * at.weight.asDiagonal() * position.line_load_derivative;
  if (position.root_influence_derivative.size() > 0) components += position.root_influence_derivative.middleRows<3>(3 * station);
  return principal_slope(principal) * components;
}

RootStressPeak root_stress_peak(const MeshPosition& at, const LoadedPosition& position, Member member) {
  RootStressPeak peak;
  if (const Eigen::Index i = highest_root_stress(at, position, {.member = member}); i >= 0) {
    peak = {position.root_stress[i], at.root_stress.stations[static_cast<std::size_t>(i)], position.phase};
  }
  if (const Eigen::Index i = highest_root_stress(at, position, {.member = member, .tangent_only = true}); i >= 0) {
    peak.tangent_stress = position.root_stress[i];
  }
  return peak;
}

Eigen::Index highest_root_stress(const MeshPosition& at, const LoadedPosition& position, const RootStations& among) {
  Eigen::Index highest = -1;
  for (Eigen::Index i = 0; i < position.root_stress.size(); ++i) {
    const RootStation& station = at.root_stress.stations[static_cast<std::size_t>(i)];
    const bool counts = station.member == among.member && (!among.tooth || station.tooth == *among.tooth) && (station.tangent || !among.tangent_only);
    if (counts && (highest < 0 || position.root_stress[i] > position.root_stress[highest])) highest = i;
  }
  return highest;
}

void CycleSummary::include(const LoadedPosition& position) {
  peak_line_load = std::max(peak_line_load, position.peak_load.maxCoeff());
  peak_contact_stress = std::max(peak_contact_stress, position.contact_stress.maxCoeff());
  if (position.edge_stress.size() > 0) edge_stress = std::fmax(edge_stress, position.edge_stress.maxCoeff());
  tip_edge_share = std::fmax(tip_edge_share, position.tip_edge_share);
  worst_kkt_residual = std::max(worst_kkt_residual, position.load.kkt_residual);
}

CycleSummary summarise(const MeshModel& model, const LoadedCycle& cycle) {
  CycleSummary summary;
  if (!cycle.usable() || cycle.positions.empty()) return summary;
  const Eigen::VectorXd te = cycle.transmission_error();
  if (te.size() > 1) summary.te_peak_to_peak = te.maxCoeff() - te.minCoeff();
  summary.te_mean = te.mean();
  summary.te_harmonics = harmonic_amplitudes({te.begin(), te.end()});
  summary.peak_line_load = summary.peak_contact_stress = summary.worst_kkt_residual = 0.0;
  double mean_approach = 0.0;
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const LoadedPosition& position = cycle.positions[i];
    summary.include(position);
    summary.worst_condition = std::fmax(summary.worst_condition, position.load.condition);
    raise(summary.pinion_root_stress, root_stress_peak(model.positions[i], position, Member::Pinion));
    raise(summary.wheel_root_stress, root_stress_peak(model.positions[i], position, Member::Wheel));
    summary.least_stiffness = std::fmin(summary.least_stiffness, position.stiffness);
    summary.largest_stiffness = std::fmax(summary.largest_stiffness, position.stiffness);
    mean_approach += position.approach();
  }
  summary.peak_root_stress = std::fmax(summary.pinion_root_stress.stress, summary.wheel_root_stress.stress);
  const double n = static_cast<double>(cycle.positions.size());
  mean_approach /= n;
  const double cos_base_helix = std::cos(model.pair.base_helix_angle);
  summary.mean_stiffness = cycle.force / model.face_width * cos_base_helix * cos_base_helix / (mean_approach / micrometre);
  summary.load_factor = summary.peak_line_load / model.mean_line_load(cycle.force);
  return summary;
}

}  // namespace flankwright
