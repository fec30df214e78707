#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/analysis/fidelity_level.hpp"
#include "studies/tasks/accuracy/accuracy_table.hpp"

namespace flankwright::studies {

/// NaN for every figure.
inline PerFigure nothing_known() {
  PerFigure figures{};
  figures.fill(not_given);
  return figures;
}

/// One level with its error compared with the finest.
struct HierarchyStep {
  LevelResult result;
  PerFigure error{};                ///< shares, worst over the load cases, see figure_errors()
  double first_seconds{not_given};  ///< of this level without kept influence values: their wall time added [s]
  /// Pareto-best: no other level is both as fast and as accurate, in the worst quantity (`best`) or in one (`best_in`).
  bool best{false};
  std::array<bool, figure_count> best_in{};
  /// By how much it exceeds the figures of the study's outside curve at the same positions, as fractions: the mean in units of the approach at the finest
  /// level, peak to peak and harmonics in units of the curve's peak to peak, at least quiet_share of the approach. NaN for figures that the curve does not have.
  PerFigure from_outside = nothing_known();
};

/// Orders of convergence along one axis whose steps halve.
struct AxisOrder {
  std::string axis;
  std::vector<int> levels;  ///< the three finest: intervals or positions, coarse to fine
  /// Observed order, the least over the load cases; NaN where it is not regular in one of them, see LimitEstimate.
  PerFigure order{};
};

/// What an outside curve says.
struct OutsideFigures {
  std::string name;
  int positions;
  PerFigure value = nothing_known();  ///< mean, peak to peak and the harmonics that the positions resolve [mm]; NaN for the others
};

struct FidelityHierarchy {
  std::vector<DesignScene> scenes;   ///< load cases
  HierarchyStep reference;           ///< the finest level
  std::vector<HierarchyStep> steps;  ///< all others
  std::vector<AxisOrder> orders;
  std::optional<OutsideFigures> outside;  ///< none where the study gives no curve
  PerFigure reference_error{};            ///< of the reference's own resolution, estimated by its last halvings, share; worst over the load cases
  double seconds{not_given};              ///< wall time of all of it
  bool usable() const { return reference.result.usable(); }
};

/// All steps, the reference first.
template <class Hierarchy>
auto all_steps(Hierarchy& hierarchy) {
  std::vector all{&hierarchy.reference};
  for (auto& step : hierarchy.steps) all.push_back(&step);
  return all;
}

/// Analyses the study's load cases at every level and compares each level with the finest.
FidelityHierarchy run_hierarchy(LevelRunner& runner, const ProgressReport& progress);

/// Marks the Pareto-best of some levels: those that no other one equals in cost and error and exceeds in one of them. Equal
/// levels all count.
std::vector<bool> pareto_best(const std::vector<double>& cost, const std::vector<double>& error);

}  // namespace flankwright::studies
