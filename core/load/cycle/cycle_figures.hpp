#pragma once

#include <array>
#include <complex>
#include <vector>

#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// The quantities in which the accuracy of a loaded cycle is measured.
enum class Figure {
  TeMean,
  TePeakToPeak,
  TeHarmonic1,
  TeHarmonic2,
  TeHarmonic3,
  TeHarmonic4,
  TeHarmonic5,
  PeakContactStress,
  PeakLineLoad,
  LoadFactor
};
inline constexpr int figure_count = 10;
inline constexpr int figure_harmonics = 5;

/// As a study names it: "te_mean", "te_harmonic_1".
const char* name_of(Figure figure);

/// One number per figure, in the order of Figure.
using PerFigure = std::array<double, figure_count>;
double largest(const PerFigure& values);
/// The largest of those that a mesh is judged by: transmission error, its harmonics and contact stress. The line load's peak, often at
/// the very end of a line, where it has half the order of the stress, and the factor that follows from it are not among them.
double headline(const PerFigure& values);
/// Errors of two independent causes: sqrt(a^2 + b^2) of each figure.
PerFigure root_sum_square(const PerFigure& a, const PerFigure& b);
/// The larger one of each figure; NaN where one of them is.
PerFigure larger_of(const PerFigure& a, const PerFigure& b);

struct CycleFigures {
  PerFigure value{};                ///< transmission error [mm], stress [MPa], line load [N/mm], load factor [-]
  double mean_approach{not_given};  ///< mean of LoadedPosition::approach_of_teeth() [mm]
  /// Of f_t, orders 1 .. figure_harmonics; their moduli are the harmonics. NaN beyond what the positions resolve [mm].
  std::array<std::complex<double>, figure_harmonics> te_phasor{};

  double operator[](Figure f) const { return value[static_cast<std::size_t>(f)]; }
  double& operator[](Figure f) { return value[static_cast<std::size_t>(f)]; }
};

/// A transmission error that varies by less than this fraction of the mean approach counts as if it varied by that much
/// [-]: harmonics of a quiet mesh are near 0, and fractions of them no measure.
inline constexpr double quiet_share = 0.02;

/// |figures - reference| as fractions: the mean of the transmission error in units of the reference's mean_approach (a
/// gap common to all positions is no deflection), its peak to peak and harmonics in units of the reference's peak to
/// peak, at least quiet_share of the approach; stress, load and factor in units of themselves.
PerFigure figure_errors(const CycleFigures& figures, const CycleFigures& reference);
/// The same with harmonics in amplitude and phase, |difference of phasors|: the difference of two models at the same
/// phases.
PerFigure figure_differences(const CycleFigures& figures, const CycleFigures& reference);

/// Possible rise of a periodic curve above its equally spaced samples, where it consists of smooth pieces with kinks
/// and jumps: both neighbours are continued straight into each interval, up to where they meet, or, where one of them
/// falls towards the other sample (a jump), the other all the way. >= 0. Unlike differences of successive maxima, it is
/// not misled by samples that meet a kink by chance.
double unseen_rise(const std::vector<double>& samples);

/// Of a cycle at equal distances; its peaks are those of the summary, which may have been sought between the positions.
CycleFigures figures_of(const LoadedCycle& cycle, const CycleSummary& summary);

}  // namespace flankwright
