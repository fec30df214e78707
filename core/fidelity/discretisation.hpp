#pragma once

#include <functional>
#include <vector>

#include "core/base/for_each_index.hpp"
#include "core/fidelity/resolved_cycle.hpp"

namespace flankwright {

/// The same mesh at any resolution.
using MeshOfResolution = std::function<MeshModel(const MeshResolution&)>;

/// One load case whose resolution is sought.
struct ResolutionCase {
  MeshOfResolution mesh_for;
  FlankCondition condition;
  double pinion_torque{not_given};  ///< [N mm], > 0
  int placement{0};                 ///< cases of one number have the same meshes, which are made once
};

/// The figures of a resolution, and their errors.
struct ResolutionLevel {
  int intervals{0}, positions{0};
  CycleFigures figures;                            ///< with extremes between the positions where they were sought
  PerFigure quadrature_error{}, position_error{};  ///< estimated shares, as figure_errors() counts them
  PerFigure error() const;                         ///< their sum
};

struct DiscretisationSearch {
  /// Refined until headline(root_sum_square(spent, ResolutionLevel::error())) <= accuracy in every load case [-], > 0.
  double accuracy{0.01};
  PerFigure spent{};                                    ///< errors of other causes, which no resolution lessens, as shares
  int fewest_intervals{6}, most_intervals{48};          ///< powers of two times the fewest; half of them must still be meaningful
  int fewest_positions{16}, most_positions{128};        ///< powers of two times the fewest, >= 12
  bool choose_intervals{true}, choose_positions{true};  ///< false: the fewest are used, and count as exact
  bool seek_extremes{true};                             ///< false: extremes are those of the positions, as they are with any rule but Graded
  std::function<void(int intervals, int positions, int load_cases)> starting{};  ///< called before every level is solved; may be empty
  ForEachIndex for_each{};  ///< over load cases; empty: one after the other. Changes nothing but the time
};

/// Points and positions that keep an accuracy in all load cases, and the evidence.
struct Discretisation {
  Quadrature quadrature;
  int positions{0};
  /// Estimated shares, worst over the load cases, each at the last level it was solved at; 0 of what was not to be chosen.
  PerFigure quadrature_error{}, position_error{}, total_error{};
  std::size_t governing{0};             ///< load case that needed the finest resolution
  std::vector<ResolutionLevel> levels;  ///< what was solved of it, coarse to fine
  bool kept{false};                     ///< headline(root_sum_square(spent, error())) <= accuracy
  int failures{0};                      ///< positions without a usable load distribution; the search ends there

  /// Of quadrature and positions together.
  const PerFigure& error() const { return total_error; }
};

/// Cheapest resolution of several load cases whose estimated error is within an accuracy.
///
/// Errors are estimated by embedded comparisons (estimate_errors()). Intervals or positions, whichever cause most of the
/// largest error, are doubled until all load cases keep the accuracy, up to search.most_intervals and
/// search.most_positions. The search ends before with kept = false where neither can bring the error down: where one of
/// them is at its limit and its error alone exceeds the accuracy in each quantity that does not keep it. The last level
/// solved is then the choice.
///
/// A load case that keeps the accuracy is not solved again, as a finer level only lessens its error; as a rule only one
/// or two reach the finest level. Extremes between positions, which cost as much as a cycle, are sought only where the
/// rest of the error is small enough.
Discretisation choose_discretisation(const std::vector<ResolutionCase>& cases, QuadratureRule rule, const DiscretisationSearch& search = {});
Discretisation choose_discretisation(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double pinion_torque,
                                     const DiscretisationSearch& search = {});

/// Figures of a resolved cycle, in the order of Figure.
CycleFigures figures_of(const MeshModel& model, const LoadedCycle& cycle, const CycleSummary& summary);
/// Estimated errors as shares, as figure_errors() counts them.
PerFigure error_shares(const CycleErrors& errors, const CycleFigures& figures);

}  // namespace flankwright
