#pragma once

#include <functional>

#include "core/fidelity/resolved_cycle.hpp"

namespace flankwright {

/// The same mesh at any resolution.
using MeshOfResolution = std::function<MeshModel(const MeshResolution&)>;

/// Start and limits of an analysis that chooses its own resolution. Points follow the rule Graded.
struct AutomaticResolution {
  double accuracy{0.01};                                ///< refined until headline_error() <= accuracy [-], > 0
  int intervals{12}, positions{32};                     ///< to begin with, >= 2 and >= 4
  int most_intervals{48}, most_positions{128};          ///< none of them is doubled beyond
  bool choose_intervals{true}, choose_positions{true};  ///< false: as they are to begin with
};

/// Whether the points along the contact lines cause at least as much of the headline error as the positions.
bool mostly_by_points(const ResolvedCycle& resolved, const LoadedCycle& cycle);

/// Doubles the intervals or the positions of a resolution, whichever cause most of the headline error and may be
/// chosen. False, with nothing changed, where neither may be chosen, or where the free one causes no more than the
/// accuracy and the other alone exceeds it.
/// @param from  the resolution of `cycle`, in `intervals` and `positions`
bool refine(AutomaticResolution& from, const ResolvedCycle& resolved, const LoadedCycle& cycle);

/// A cycle at a resolution that suffices.
struct ResolvedAnalysis {
  MeshResolution resolution;
  MeshModel model;
  LoadedCycle cycle;        ///< of it
  ResolvedCycle resolved;   ///< its figures and their errors
  double error{not_given};  ///< headline_error() [-]; NaN where a position failed
};

/// Analyses one load case like a study without a given resolution: from a coarse resolution on, intervals or positions,
/// whichever cause most of the error, are doubled until the accuracy is kept or the limits are reached.
/// @param pinion_torque  [N mm], > 0
/// @throws InvalidInput  as `mesh_for` does
ResolvedAnalysis analyse_resolved(const MeshOfResolution& mesh_for, const FlankCondition& condition, double pinion_torque,
                                  AutomaticResolution automatic = {});

}  // namespace flankwright
