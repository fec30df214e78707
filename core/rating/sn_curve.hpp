#pragma once

#include <limits>
#include <string_view>

namespace flankwright {

/// Stress against the number of load cycles that it is borne for, straight in logarithms on either side of the knee:
///
///     N = N_k (sigma_k / sigma)^p,    p = exponent where sigma >= sigma_k, exponent_beyond where it is less
///
/// N falls with the stress everywhere and has no jump, so that sums of 1/N have slopes. Where exponent_beyond is the exponent, it is Miner's
/// elementary rule; a larger one lets small stresses count less. Above the static limit a gear fails at once, whatever N is: the formula goes on
/// there, and results say that the limit is exceeded.
struct SnCurve {
  double limit{0.0};                                             ///< sigma_k, borne for `knee` cycles [MPa], > 0
  double knee{5e7};                                              ///< N_k [-], > 0
  double exponent{13.2};                                         ///< p above the limit [-], > 0
  double exponent_beyond{13.2};                                  ///< p below it [-], > 0
  double static_limit{std::numeric_limits<double>::infinity()};  ///< [MPa], above `limit`

  /// @throws InvalidInput "limit", "knee", "exponent", "exponent_beyond" or "static_limit"
  void validate() const;

  /// N; infinite without stress [-].
  double cycles_to_failure(double stress) const;
  /// The stress that is borne for N cycles, limit * life factor, at most the static limit [MPa].
  double stress_for(double cycles) const;
  /// The same, and the limit itself where the cycles are not known (NaN): what is borne for ever [MPa].
  double stress_borne(double cycles) const;

  struct Damage {
    double value{0.0};  ///< 1/N [-]
    double slope{0.0};  ///< by the stress [1/MPa]; at the knee that of the larger stresses
  };
  /// Of one load cycle; 0 without stress.
  Damage damage(double stress) const;

  /// The curve of a stress that acts `factor` times as large as it is counted: both its limits over the factor.
  /// @param factor  [-], > 0
  SnCurve of_stress_times(double factor) const;
};

/// Materials and heat treatments whose life factors ISO 6336 gives.
enum class LifeFactors { ThroughHardened, CaseHardened, Nitrided, Nitrocarburised };

/// "through_hardened", "case_hardened", "nitrided", "nitrocarburised".
std::string_view to_string(LifeFactors kind);

/// A curve through the points of the life factor Z_NT [ISO 6336-2:2006, table 2, without pitting that is permitted]:
///
///     through- and case-hardened (St, V, Eh, IF)   1.6 at 1e5,  1 at 5e7,  0.85 at 1e10 cycles
///     nitrided (NT, NV nitrided)                   1.3 at 1e5,  1 at 2e6,  0.85 at 1e10
///     nitrocarburised (NV nitrocarburised)         1.1 at 1e5,  1 at 2e6,  0.85 at 1e10
///
/// and beyond the last by the same slope. Their exponents by torque, half of those by stress, are 6.610, 5.709 and 15.715, as in ISO 6336-6. The static
/// limit is at the first point.
/// @param endurance_limit  sigma_Hlim times the factors of lubricant, speed, roughness, hardness and size [MPa], > 0
SnCurve contact_sn_curve(LifeFactors kind, double endurance_limit);

/// The same by the life factor Y_NT [ISO 6336-3:2006, table 1]:
///
///     through-hardened   2.5 at 1e4,  1 at 3e6,  0.85 at 1e10      (p = 6.225 between the first two)
///     case-hardened      2.5 at 1e3,  1 at 3e6,  0.85 at 1e10      (8.738)
///     nitrided           1.6 at 1e3,  1 at 3e6,  0.85 at 1e10      (17.035)
///     nitrocarburised    1.1 at 1e3,  1 at 3e6,  0.85 at 1e10      (84.003)
///
/// @param notched_limit  sigma_FE = 2 sigma_Flim, Y_ST = 2, that a fillet's own largest stress compares with [MPa], > 0
SnCurve root_sn_curve(LifeFactors kind, double notched_limit);

}  // namespace flankwright
