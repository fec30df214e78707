#pragma once

#include <string>
#include <vector>

#include "studies/analysis/fidelity_level.hpp"

namespace flankwright::studies {

/// One rung beside the finest.
struct HierarchyStep {
  LevelResult result;
  PerFigure error{};               ///< shares, worst over the load cases, see figure_errors()
  double first_seconds{not_given};  ///< of this rung where no influence values are kept yet: theirs (wall) added [s]
  /// No other rung is both as fast and as close in the worst figure (all), in this one figure (the array).
  bool best{false};
  std::array<bool, figure_count> best_in{};
};

/// How figures converge along one axis whose steps halve.
struct AxisOrder {
  std::string axis;
  std::vector<int> levels;  ///< the three finest: intervals or positions, coarse to fine
  /// Observed order, the least over the load cases; NaN where it is not regular in one of them, see LimitEstimate.
  PerFigure order{};
};

struct FidelityHierarchy {
  std::vector<DesignScene> scenes;  ///< load cases
  HierarchyStep reference;           ///< the finest rung
  std::vector<HierarchyStep> steps;  ///< all others
  std::vector<AxisOrder> orders;
  PerFigure reference_error{};    ///< of the reference's own resolution, estimated by its last halvings, share; worst over the load cases
  double seconds{not_given};      ///< wall time of all of it
  bool usable() const { return reference.result.usable(); }
};

/// The rungs of a study's ladder, the finest first: one axis varied at a time from there, whole settings after.
std::vector<FidelityLevel> hierarchy_levels(const LevelRunner& runner);

/// Runs every rung of the study's load cases and holds them against the finest.
FidelityHierarchy run_hierarchy(LevelRunner& runner, const ProgressReport& progress);

/// Which of some rungs no other one is at least as good as in cost and error, and better in one. Equal ones all count.
std::vector<bool> pareto_best(const std::vector<double>& cost, const std::vector<double>& error);

}  // namespace flankwright::studies
