#pragma once

#include <functional>
#include <vector>

#include "core/load/cycle_figures.hpp"

namespace flankwright {

/// The same mesh as finely as one likes.
using MeshOfResolution = std::function<MeshModel(const MeshResolution&)>;

/// Figures of a cycle on one rung of a ladder of finer and finer resolutions.
struct ResolutionLevel {
  int intervals{0}, positions{0};
  CycleFigures figures;
  PerFigure error{};  ///< estimated share, see figure_errors(); of quadrature or of positions alone
};

struct DiscretisationSearch {
  /// Refined until estimated error <= accuracy, of every figure [-], > 0.
  double accuracy{0.01};
  int fewest_intervals{4}, most_intervals{64};    ///< Graded; powers of two times the fewest
  int fewest_positions{16}, most_positions{256};  ///< powers of two times the fewest, >= 12
  bool choose_intervals{true}, choose_positions{true};  ///< false: the fewest stand
};

/// Points and positions that keep an accuracy, and the evidence.
struct Discretisation {
  Quadrature quadrature;
  int positions{0};
  PerFigure quadrature_error{}, position_error{};  ///< estimated shares at these
  std::vector<ResolutionLevel> by_intervals, by_positions;  ///< what was solved, coarse to fine
  bool kept{false};       ///< their sum <= accuracy
  int failures{0};        ///< positions without a usable load distribution; the search ends there

  PerFigure error() const;
};

/// Cheapest resolution of one load case whose estimated error is within an accuracy: intervals first, at the fewest positions, within
/// half of it, then positions within what that leaves. Each is doubled until a level before the last keeps for every figure
///
///     (its distance from the last) + safety * (LimitEstimate::error of the last, by the last three) <= budget,
///
/// and the coarsest that does is taken. Its error is mostly a difference that was measured. The last level itself is taken where nothing
/// finer is allowed, on its estimate alone, which is the one that may be far too large. Of 60 random cases at 1 % (seeds 5000 on, before the lean
/// of end faces was in the contact law) the true error was within the stated one in 59, one was overstated more than tenfold. With a safety of
/// 1.25 it was within in 188 of 200 others, 8 overstated; with 1.5, on a later state of contact, in 187, 9 overstated: short of 190 and 0.
Discretisation choose_discretisation(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double pinion_torque,
                                     const DiscretisationSearch& search = {});

}  // namespace flankwright
