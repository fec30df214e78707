#pragma once

#include "core/gear/pair_geometry.hpp"

namespace flankwright {

/// The data on which the tolerances of one gear depend.
struct ToleranceData {
  int teeth{0};                          ///< z, 5 .. 1000
  double reference_diameter{not_given};  ///< d [mm], 5 .. 15000
  double normal_module{not_given};       ///< m_n [mm], 0.5 .. 70
  double face_width{not_given};          ///< b [mm], 4 .. 1200
  double helix_angle{not_given};         ///< |beta| [rad], 0 .. 45 deg

  static ToleranceData of(const GearPair& pair, Member member);
};

/// Flank tolerances of one gear by ISO 1328-1:2013 [mm]; see flank_tolerances(). A single pitch deviates by at most its tolerance either
/// way, and so does a slope; a total, a form deviation and the cumulative pitch deviation are ranges, highest minus lowest.
struct FlankTolerances {
  double single_pitch{not_given};      ///< f_pT, +-
  double cumulative_pitch{not_given};  ///< F_pT, range
  double profile_slope{not_given};     ///< f_HalphaT, +-
  double profile_form{not_given};      ///< f_falphaT, range
  double profile_total{not_given};     ///< F_alphaT, range
  double helix_slope{not_given};       ///< f_HbetaT, +-
  double helix_form{not_given};        ///< f_fbetaT, range
  double helix_total{not_given};       ///< F_betaT, range
};

/// The standard's formulae, with d, m_n and b in mm and the tolerances of class A in um [ISO 1328-1:2013, 5.3.2 .. 5.3.9]:
///
///     f_pT      = (0.001 d + 0.4 m_n + 5)                    sqrt(2)^(A-5)
///     F_pT      = (0.002 d + 0.55 sqrt(d) + 0.7 m_n + 12)    sqrt(2)^(A-5)
///     f_HalphaT = (0.4 m_n + 0.001 d + 4)                    sqrt(2)^(A-5)
///     f_falphaT = (0.55 m_n + 5)                             sqrt(2)^(A-5)
///     f_HbetaT  = (0.05 sqrt(d) + 0.35 sqrt(b) + 4)          sqrt(2)^(A-5)
///     f_fbetaT  = (0.07 sqrt(d) + 0.45 sqrt(b) + 4)          sqrt(2)^(A-5)
///     F_alphaT^2 = f_HalphaT^2 + f_falphaT^2,   F_betaT^2 = f_HbetaT^2 + f_fbetaT^2   (of unrounded parts)
///
/// Helix tolerances hold over the face width b, where the standard takes the evaluation length: slopes here are stated over b.
/// The tolerances are measured along the transverse base tangent, as errors are here. Not rounded: see rounded_tolerance().
///
/// @param tolerance_class  A, 1 (finest) .. 11
/// @throws InvalidInput naming what lies outside the standard's range ("iso_1328_class", "teeth", "reference_diameter" ...)
FlankTolerances flank_tolerances(const ToleranceData& gear, int tolerance_class);

/// A tolerance as drawings state it [mm]: above 10 um to whole um, from 5 to 10 um to 0.5 um, below to 0.1 um; halves away from zero.
double rounded_tolerance(double tolerance);

}  // namespace flankwright
