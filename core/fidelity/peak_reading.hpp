#pragma once

#include <functional>
#include <vector>

#include "core/fidelity/cycle_extremes.hpp"

namespace flankwright {

/// A reading of a loaded mesh position; >= 0.
using PositionReading = std::function<double(const MeshPosition&, const LoadedPosition&)>;
/// The largest of a reading over the points of a position; 0 without any.
PositionReading largest_of_points(PointReading reading);

/// The largest value of a reading over positions and extremes, and its estimated error by what brings it, in its own unit.
struct PeakReading {
  double value{not_given};
  double by_points{not_given}, by_positions{not_given};  ///< >= 0; NaN: not estimated

  double error() const { return by_points + by_positions; }
};

/// A solved cycle and its mesh; null: there is none.
struct SolvedCycle {
  const MeshModel* model{nullptr};
  const LoadedCycle* cycle{nullptr};

  /// Of every position; empty where there is no cycle.
  std::vector<double> readings(const PositionReading& reading) const {
    std::vector<double> all;
    for (std::size_t i = 0; cycle != nullptr && i < cycle->positions.size(); ++i) all.push_back(reading(model->positions[i], cycle->positions[i]));
    return all;
  }
};

/// A load case at its positions and at its extremes between them, by the intervals of the study and by fewer.
struct SolvedCycles {
  SolvedCycle fine{}, coarse{}, fine_between{}, coarse_between{};
};

/// @param extremes  phases of both cycles between the positions [base pitches]
/// @param unseen    by the search for extremes; NaN: there was none
PeakReading peak_of(const PositionReading& reading, const SolvedCycles& of, const std::vector<double>& extremes, double unseen);
/// Its error by points beside a finer cycle at the same positions, as point_errors_beside_finer() has it for the peak contact stress.
double point_error_beside_finer(const PositionReading& reading, const PeakReading& stated, const SolvedCycle& cycle, const SolvedCycle& finer);

/// The error of the stress on the edges of a gear that are not seen to touch [MPa]: the pressure at the point nearest to its mate, if the edge were pressed in as far as the
/// errors of its approach allow; 0 where it stays clear all the same. The pressure grows as the square root of the approach, so that a small one decides.
/// @param extremes  of the load case, after a search
double untouched_edge_error(const SolvedCycles& of, const CycleExtremes& extremes, Member gear);

}  // namespace flankwright
