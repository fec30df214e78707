#pragma once

#include <vector>

#include "core/fidelity/cycle_extremes.hpp"

namespace flankwright {

/// Estimated discretisation errors of a CycleSummary, each in its figure's unit and >= 0; NaN, or no harmonics: not estimated.
using CycleErrors = CycleValues<double, std::vector<double>>;

/// Errors by what brings them: points along the contact lines, or positions over the cycle.
struct CycleErrorParts {
  CycleErrors points, positions;
  /// A stress on tip edges, with its error, is part of the peak contact stress: the error of that reaches as far.
  /// @param summary  that is shown, with extremes between the positions
  CycleErrors sum(const CycleSummary& summary) const;
};

/// The positions of an evenly spaced cycle at which the coarser one is solved: every second where their number is even
/// and at least 8, else all.
std::vector<double> coarse_phases(const std::vector<double>& phases);

/// One contact problem with two numbers of intervals, at the same phases between the positions of a cycle; null: not solved there.
struct CyclesBetween {
  const LoadedCycle *fine{nullptr}, *coarse{nullptr};
};

/// How far a cycle's figures are from those of infinitely many points and positions, by an embedded comparison: the same contact
/// problem with half the intervals at every second position.
///
/// - Points, with d the difference of f_t at a position, fine less coarse:
///   - The mean is off by |mean d|/2 + rms(d - mean d)/3. The second part is there because positions may make up for each other by chance.
///   - What remains in the shape comes from kinks of the load between points. As a kink wanders from point to point its error runs from none to J h^2/8,
///     with J the change of slope and h the distance of the points, so that d covers four times the range by which the fine curve is off. A third is
///     taken, because some of the error converges more slowly. The peak to peak is off by (max d - min d)/3. Harmonic k is off by
///     (|DFT_k d| + rms(d - mean d))/2: a single order may be small by chance, and where kinks wander its fine and coarse errors do not point the same way.
///   - Peaks of root stress are off by half of what changes. The mean stiffness is off by twice what the mean deflection would be, because the least gap of the points converges with order
///     one. The least and the largest stiffness have the same relative error, and half the range of the differences beside it.
///   - Peaks of stress and load mostly lie at the ends of lines and converge with order one at least. They are off by the largest difference of both
///     peaks around any position that comes within a tenth of the peak, a sixteenth of the cycle to either side. Position by position they would differ
///     by more: kinks of a linear relief wander between points. Both cycles are compared at the extremes between the positions as well, where they
///     were solved there: a contact on a tip edge may be shorter than the spacing of the positions.
/// - Positions: amplitudes of a curve with kinks converge with order two: a third of what leaving out every second
///   position changes, of the mean at least a third of the highest order that they resolve, which does not depend on where positions meet the curve. Where teeth differ (LoadedCycle::closes) the
///   curve jumps from one pitch to the next, which is order one: all of the change instead of a third. Extremes are off by CycleExtremes::unseen after a search, else by unseen_rise().
///
/// @param fine      evenly spaced, with its summary
/// @param coarse    at coarse_phases() of it, half the intervals
/// @param extremes  of the fine cycle; null: not sought
/// @param between   usable, with as many intervals as `fine` and `coarse`
CycleErrorParts estimate_errors(const LoadedCycle& fine, const CycleSummary& summary, const LoadedCycle& coarse,
                                const CycleExtremes* extremes = nullptr, const CyclesBetween& between = {});

/// Where the largest stress is on a tip edge both are one figure, with one error, the larger of the two.
/// @param summary  that is shown, with extremes between the positions
void join_edge_to_peak(const CycleSummary& summary, CycleErrors& errors);

/// Estimated discretisation error of the mean of a reading that every mesh position has, by points and positions, as estimate_errors() has it for the mean
/// transmission error: in the reading's unit, >= 0.
/// @param fine    at evenly spaced positions over one base pitch, at least 4
/// @param coarse  at coarse_phases() of them, with half the intervals
double mean_error(const std::vector<double>& fine, const std::vector<double>& coarse);

/// A reading of both cycles whose largest value counts.
struct PeakReadings {
  std::vector<double> fine, coarse;                      ///< at the positions, as for mean_error(); >= 0
  std::vector<double> between{};                         ///< phases of extremes between the positions [base pitches]; empty: not known
  std::vector<double> fine_between{}, coarse_between{};  ///< at these
};

/// Likewise of the largest value of a reading by points, as estimate_errors() has it for the peak contact stress.
double peak_error_by_points(const PeakReadings& of);

/// Of a figure that is held against a finer one.
/// @param change  between both
/// @param beyond  what the finer one may be off by itself
/// @param stated  before; NaN: not estimated
double error_beside_finer(double change, double beyond, double stated);

/// The errors by points of a cycle that is held against a finer one, with more intervals at the same positions: each is what the two differ by, and the finer
/// one's own error, which estimate_errors() takes from the same difference; that of the transmission error is doubled, which makes the sum that of order one.
/// Half the intervals may meet a tip edge that neither of the two meets, so that these are often far narrower. A figure that the finer cycle does not have keeps what is `stated`. So does a figure whose stated error is smaller and covers
/// what changes.
/// @param summary, finer_summary  of the positions alone
CycleErrors point_errors_beside_finer(const CycleErrors& stated, const LoadedCycle& cycle, const CycleSummary& summary, const LoadedCycle& finer,
                                      const CycleSummary& finer_summary);

/// The largest error of what a study is judged by, as figure_errors() counts it: peak to peak and harmonics 1 to 5 in units of the peak to
/// peak, at least quiet_share of the mean deflection; contact stress in units of itself. NaN where it was not estimated.
double headline_error(const CycleErrors& errors, const CycleSummary& summary, const LoadedCycle& cycle);

}  // namespace flankwright
