#pragma once

#include "core/gear/gear_pair.hpp"
#include "core/load/cycle/cycle_figures.hpp"
#include "studies/compliance/gear_structures.hpp"

namespace flankwright::studies {

/// How far figures by compliance "fitted" may be from those by "fe", as shares in the sense of figure_differences():
///
///     mean            0.15 %                      contact stress   0.4 %             line load and load factor   2 %
///     peak to peak    0.5 % + a Df/V              harmonics        0.4 % + a Df/V
///
/// Df the mean deflection, V what the variation counts in (the peak to peak, at least quiet_share Df), and a = 0.003 % for gears that
/// the library knows and whose reference profile is near the standard one, 0.03 % for others. Set by 28 load cases of twelve pairs beside
/// finite elements, eight pairs of them of the standard profile (README.md: mean up to 0.08 %, stress up to 0.28 %), harmonics in amplitude and phase: by
/// amplitude alone half of a would do, and left one of the 28 at 1.26 % with 1.15 % stated. What a fit leaves is local and hardly moves the
/// mean, but a quiet mesh of a profile that the library has few gears of notices it.
PerFigure fit_error(const CycleFigures& fitted, bool near_standard);

/// Whether the library knows both gears and their profile departs by no more than 0.05 modules from the standard one, 1 / 1.25 / 0.39, and their
/// pressure angle by no more than half a degree from 20.
bool near_standard(const GearPair& pair, const GearStructures& fitted);

}  // namespace flankwright::studies
