#include "core/load/cycle/cycle_gradient.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <limits>

namespace flankwright {

namespace {

/// The location of the largest entry over all positions.
struct PeakLocation {
  int position{0};
  Eigen::Index index{0};
};

/// @param values_of  of a position: an entry per contact point or fillet point
template <class Values>
PeakLocation location_of_peak(const LoadedCycle& cycle, const Values& values_of) {
  PeakLocation location;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    Eigen::Index index = 0;
    const double value = values_of(cycle.positions[i]).maxCoeff(&index);
    if (!(value > largest)) continue;
    largest = value;
    location = {static_cast<int>(i), index};
  }
  return location;
}

const LoadedPosition& at(const LoadedCycle& cycle, const PeakLocation& location) {
  return cycle.positions[static_cast<std::size_t>(location.position)];
}

/// A secant stiffness ~ F / (b approach) follows all three.
Eigen::RowVectorXd secant_derivative(const LoadedCycle& cycle, double stiffness, double approach, const Eigen::RowVectorXd& d_approach) {
  return stiffness * (cycle.force_derivative / cycle.force - cycle.face_width_change - d_approach / approach);
}

/// Of the highest of these fillet points over all positions; empty where there is none.
Eigen::RowVectorXd root_derivative(const MeshModel& model, const LoadedCycle& cycle, const RootStations& among) {
  PeakLocation highest{0, -1};
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const Eigen::Index index = highest_root_stress(model.positions[i], cycle.positions[i], among);
    if (index < 0) continue;
    if (highest.index >= 0 && !(cycle.positions[i].root_stress[index] > at(cycle, highest).root_stress[highest.index])) continue;
    highest = {static_cast<int>(i), index};
  }
  if (highest.index < 0) return {};
  return root_stress_derivative(model.positions[static_cast<std::size_t>(highest.position)], at(cycle, highest), highest.index);
}

CycleGradient::Root root_gradient(const MeshModel& model, const LoadedCycle& cycle, Member member) {
  return {root_derivative(model, cycle, {.member = member}), root_derivative(model, cycle, {.member = member, .tangent_only = true})};
}

}  // namespace

TeHarmonic te_harmonic(const LoadedCycle& cycle, int order) {
  const auto n = static_cast<double>(cycle.positions.size());
  std::complex<double> sum = 0.0;
  Eigen::RowVectorXcd derivative = Eigen::RowVectorXcd::Zero(cycle.positions.front().transmission_error_derivative.size());
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const std::complex<double> factor = std::polar(2.0 / n, -2.0 * units::pi * order * static_cast<double>(i) / n);
    sum += factor * cycle.positions[i].load.transmission_error;
    derivative += factor * cycle.positions[i].transmission_error_derivative;
  }
  const double amplitude = std::abs(sum);
  const std::complex<double> direction = amplitude > 0.0 ? std::conj(sum) / amplitude : 0.0;
  return {amplitude, (direction * derivative).real(), sum, derivative};
}

Eigen::RowVectorXd load_factor_derivative(const MeshModel& model, const LoadedCycle& cycle, int position, Eigen::Index point) {
  const LoadedPosition& here = cycle.positions[static_cast<std::size_t>(position)];
  const Eigen::RowVectorXd mean_change = cycle.force_derivative / cycle.force - cycle.face_width_change;
  return (here.peak_load_derivative.row(point) - here.peak_load[point] * mean_change) / model.mean_line_load(cycle.force);
}

Eigen::RowVectorXd stiffness_derivative(const LoadedCycle& cycle, const LoadedPosition& position) {
  return secant_derivative(cycle, position.stiffness, position.approach(), position.approach_derivative);
}

CycleGradient summary_gradient(const MeshModel& model, const LoadedCycle& cycle, const CycleSummary& summary) {
  assert(cycle.usable());
  CycleGradient gradient;
  const Eigen::Index m = cycle.force_derivative.size();
  const auto n = static_cast<double>(cycle.positions.size());
  gradient.te_mean = Eigen::RowVectorXd::Zero(m);
  Eigen::RowVectorXd mean_approach_derivative = Eigen::RowVectorXd::Zero(m);
  double mean_approach = 0.0;
  for (const LoadedPosition& position : cycle.positions) {
    gradient.te_mean += position.transmission_error_derivative / n;
    mean_approach_derivative += position.approach_derivative / n;
    mean_approach += position.approach() / n;
  }
  gradient.mean_stiffness = secant_derivative(cycle, summary.mean_stiffness, mean_approach, mean_approach_derivative);
  const auto [least, largest] = std::ranges::minmax_element(cycle.positions, {}, &LoadedPosition::stiffness);
  gradient.least_stiffness = stiffness_derivative(cycle, *least);
  gradient.largest_stiffness = stiffness_derivative(cycle, *largest);

  Eigen::Index highest = 0, lowest = 0;
  const Eigen::VectorXd te = cycle.transmission_error();
  te.maxCoeff(&highest);
  te.minCoeff(&lowest);
  gradient.te_peak_to_peak = cycle.positions[static_cast<std::size_t>(highest)].transmission_error_derivative -
                             cycle.positions[static_cast<std::size_t>(lowest)].transmission_error_derivative;
  gradient.te_harmonics.resize(static_cast<Eigen::Index>(summary.te_harmonics.size()), m);
  for (Eigen::Index k = 0; k < gradient.te_harmonics.rows(); ++k) {
    gradient.te_harmonics.row(k) = te_harmonic(cycle, static_cast<int>(k) + 1).derivative;
  }

  const PeakLocation load = location_of_peak(
      cycle, [](const LoadedPosition& p) -> const auto& { return p.peak_load; });
  gradient.peak_line_load = at(cycle, load).peak_load_derivative.row(load.index);
  gradient.load_factor = load_factor_derivative(model, cycle, load.position, load.index);
  const PeakLocation stress = location_of_peak(
      cycle, [](const LoadedPosition& p) -> const auto& { return p.contact_stress; });
  gradient.peak_contact_stress = at(cycle, stress).contact_stress_derivative.row(stress.index);
  gradient.edge_stress = Eigen::RowVectorXd::Zero(m);
  if (summary.edge_stress > 0.0) {
    const PeakLocation edge = location_of_peak(
        cycle, [](const LoadedPosition& p) -> const auto& { return p.edge_stress; });
    gradient.edge_stress = at(cycle, edge).edge_stress_derivative.row(edge.index);
  }
  const auto most_on_edges = std::ranges::max_element(cycle.positions, {}, &LoadedPosition::tip_edge_share);
  gradient.tip_edge_share = summary.tip_edge_share > 0.0 ? most_on_edges->tip_edge_share_derivative : Eigen::RowVectorXd::Zero(m);
  gradient.pinion_root_stress = root_gradient(model, cycle, Member::Pinion);
  gradient.wheel_root_stress = root_gradient(model, cycle, Member::Wheel);
  const bool wheel_governs = std::isgreater(summary.wheel_root_stress.stress, summary.pinion_root_stress.stress);
  gradient.peak_root_stress = (wheel_governs ? gradient.wheel_root_stress : gradient.pinion_root_stress).stress;
  return gradient;
}

}  // namespace flankwright
