#include "core/fidelity/peak_reading.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fidelity/cycle_error.hpp"
#include "core/fidelity/edge_approach.hpp"

namespace flankwright {

PositionReading largest_of_points(PointReading reading) {
  return [reading = std::move(reading)](const MeshPosition& at, const LoadedPosition& loaded) {
    double largest = 0.0;
    for (Eigen::Index i = 0; i < loaded.peak_load.size(); ++i) largest = std::fmax(largest, reading(loaded_point(at, loaded, i)));
    return largest;
  };
}

PeakReading peak_of(const PositionReading& reading, const SolvedCycles& of, const std::vector<double>& extremes, double unseen) {
  PeakReadings all{of.fine.readings(reading), of.coarse.readings(reading)};
  const std::vector<double> between = of.fine_between.readings(reading);
  PeakReading peak{.value = std::ranges::max(all.fine)};
  for (const double value : between) peak.value = std::max(peak.value, value);
  if (all.coarse.empty()) return peak;
  if (of.coarse_between.cycle != nullptr) {
    all.between = extremes;
    all.fine_between = between;
    all.coarse_between = of.coarse_between.readings(reading);
  }
  peak.by_points = peak_error_by_points(all);
  peak.by_positions = std::isnan(unseen) ? unseen_rise(all.fine) : unseen;
  return peak;
}

double point_error_beside_finer(const PositionReading& reading, const PeakReading& stated, const SolvedCycle& cycle, const SolvedCycle& finer) {
  const PeakReadings both{finer.readings(reading), cycle.readings(reading)};
  const double change = std::abs(std::ranges::max(both.fine) - std::ranges::max(both.coarse));
  return error_beside_finer(change, peak_error_by_points(both), stated.by_points);
}

double untouched_edge_error(const SolvedCycles& of, const CycleExtremes& extremes, Member gear) {
  // Raised by the mean deflection, a peak of the approach can be treated as one of stress.
  double deflection = 0.0;
  for (const LoadedPosition& position : of.fine.cycle->positions)
    deflection += position.approach_of_teeth() / static_cast<double>(of.fine.cycle->positions.size());
  const PositionReading raised = [&](const MeshPosition& at, const LoadedPosition& loaded) {
    return std::fmax(0.0, edge_approach(at, loaded, gear).approach + deflection);
  };
  const double reach = extremes.edge_approach[gear] + peak_of(raised, of, extremes.phases, 0.0).by_points;
  if (!(reach > 0.0)) return 0.0;
  EdgeApproach nearest;
  const MeshPosition* at = nullptr;
  const LoadedPosition* loaded = nullptr;
  for (const SolvedCycle& solved : {of.fine, of.fine_between}) {
    for (std::size_t i = 0; solved.cycle != nullptr && i < solved.cycle->positions.size(); ++i) {
      const EdgeApproach edge = edge_approach(solved.model->positions[i], solved.cycle->positions[i], gear);
      if (edge.point < 0 || edge.approach <= nearest.approach) continue;
      nearest = edge;
      at = &solved.model->positions[i];
      loaded = &solved.cycle->positions[i];
    }
  }
  return at == nullptr ? 0.0 : edge_pressure_at(*at, *loaded, nearest, reach);
}

}  // namespace flankwright
