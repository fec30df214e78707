#pragma once

#include <functional>
#include <limits>
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
  int fewest_intervals{4}, most_intervals{64};    ///< Graded; powers of two times the fewest; compared with up to twice as many
  int fewest_positions{16}, most_positions{256};  ///< powers of two times the fewest, >= 12; compared with up to twice as many
  bool choose_intervals{true}, choose_positions{true};  ///< false: the fewest stand
};

/// Points and positions that keep an accuracy, and the evidence.
struct Discretisation {
  Quadrature quadrature;
  int positions{0};
  PerFigure quadrature_error{}, position_error{};  ///< estimated shares at these, each as if the other were exact
  /// The largest of what figures differ by from twice the intervals at twice the positions, share; infinite where not both were chosen.
  double doubled_difference{std::numeric_limits<double>::infinity()};
  /// What was solved, coarse to fine; intervals at the fewest positions, then at those chosen.
  std::vector<ResolutionLevel> by_intervals, by_positions;
  bool kept{false};       ///< error() <= accuracy
  int failures{0};        ///< positions without a usable load distribution; the search ends there

  /// min(quadrature_error + position_error, 5 doubled_difference): ripples of line ends between positions are in both, and go with either.
  PerFigure error() const;
};

/// Cheapest resolution of one load case whose estimated error is within an accuracy.
///
/// 1. Intervals, at the fewest positions, doubled until a level before the last keeps for every figure
///
///        (its distance from the last) + safety * (LimitEstimate::error of the last, by the last three) <= half the accuracy;
///
///    the coarsest that does is taken.
/// 2. Positions, at these intervals, in the same way, within what that leaves, or half the accuracy; the error of the last is at least
///    SampledCycle::unseen().
///    And on, to twice the most, until the estimate is at most three times the distance from the last: mostly measured.
/// 3. Intervals again, at these positions: their error is safety * (distance from twice the intervals), and they are doubled until the
///    sum is within the accuracy. Between the fewest positions a line's end may ripple ten times as much. Where the sum is not, 2 and 3 once
///    more, positions within what these intervals leave.
/// 4. Both doubled, see Discretisation::error().
///
/// What is chosen has been held against something finer. Of 200 random cases at 1 % the true error, beside three times the intervals at
/// four times the positions, was within the stated one and at least a tenth of it in 193 (without step 4 in 189).
Discretisation choose_discretisation(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double pinion_torque,
                                     const DiscretisationSearch& search = {});

}  // namespace flankwright
