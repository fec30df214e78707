#pragma once

#include "core/compliance/thin_slice/iso_stiffness.hpp"
#include "core/contact/assembly/flank_condition.hpp"
#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// Deviations of a mesh as ISO 6336-1 sees them: one number along the face, one along the profile. In the transverse
/// plane along the base tangent [mm], >= 0. If teeth differ, the worst, over as many pairs in turn as the longer list
/// has entries.
struct IsoDeviations {
  /// F_beta_y: linear part of the gap along the face over the common face width: helix slopes of both gears, errors and
  /// modifications, and everything that misaligns, the shafts' f_sh under the load among it: as it comes out of their deflection, without
  /// the factor 1.33 that the standard gives its own formula for f_sh. Crowning, end relief and running-in (y_beta = 0) are ignored.
  double misalignment{not_given};
  /// f_pe: the larger of the largest adjacent base pitch error of either gear and the profile deviation of both together
  /// between A and E at mid face (f_f instead of f_pe where that is larger, as the standard says). Errors only: deliberate
  /// profile modifications are not deviations.
  double base_pitch{not_given};
};
/// @param shaft_misalignment  f_sh, with the sign of Misalignment::mesh_misalignment, see shaft_misalignment() [mm], not NaN
IsoDeviations iso_deviations(const GearPair& pair, const FlankCondition& condition, double shaft_misalignment = 0.0);

/// Load distribution factors by ISO 6336-1, method C, with K_A = K_v = 1, from these deviations and the standard's own stiffness.
struct IsoLoadFactors {
  IsoDeviations deviations;
  double specific_load{not_given};                    ///< F_m/b = F_t/b at the reference circle [N/mm]
  double running_in{not_given};                       ///< y_alpha = 0.075 f_pe, at most 3 um: case-hardened gears [mm]
  double lead{not_given};                             ///< K_Hbeta [-], >= 1
  double profile{not_given};                          ///< K_Halpha [-], 1 .. profile_limit
  double profile_limit{not_given};                    ///< eps_gamma / (eps_alpha Z_eps^2) [-]
  double combined() const { return lead * profile; }  ///< K_H [-], Haddad eq. 4.15a
};

/// With c = c_gamma, F_tH = F_t K_Hbeta [Haddad 1991, eqs 1.12, 1.13 and 1.15, after the draft of ISO 6336-1 of his time]:
///
///     q = F_beta_y c / (F_m/b):   K_Hbeta = 1 + q/2 where q <= 2, else sqrt(2 q)
///     eps_gamma <= 2:             K_Halpha = eps_gamma/2 (0.9 + 0.4 c (f_pe - y_alpha) / (F_tH/b))
///     eps_gamma > 2:              K_Halpha = 0.9 + 0.4 sqrt(2 (eps_gamma - 1)/eps_gamma) c (f_pe - y_alpha) / (F_tH/b)
///
/// within 1 and eps_gamma/(eps_alpha Z_eps^2), Z_eps^2 = (4 - eps_alpha)(1 - eps_beta)/3 + eps_beta/eps_alpha, eps_beta
/// at most 1. (Eq. 1.13b prints "> 2" for a value that is at most 2.) Editions since 2006 take 0.85 c_gamma for
/// K_Hbeta; the thesis' form is kept because its comparison is repeated here.
/// @param pinion_torque  [N mm], > 0
/// @param face_width     common [mm]
IsoLoadFactors iso_load_factors(const GearPair& pair, const IsoStiffness& stiffness, const IsoDeviations& deviations, double pinion_torque,
                                double face_width);

/// f_sh and its derivatives with respect to the parameters.
struct ShaftMisalignment {
  double value{0.0};              ///< [mm]
  Eigen::RowVectorXd derivative;  ///< 1 x m; empty: none
};

/// Derivatives of IsoLoadFactors and IsoDeviations::misalignment, 1 x m each. All else depends on errors and geometry alone. On a kink (no
/// misalignment, equal teeth, a limit of K_Halpha) that of the one that counts.
struct IsoGradient {
  Eigen::RowVectorXd misalignment, specific_load, lead, profile, combined;
};
/// @param factors  iso_load_factors() of the condition, under some torque
/// @param cycle    of the same condition and torque: how force and face width change with the parameters
/// @param shafts   of the factors
IsoGradient iso_gradient(const MeshModel& model, const FlankCondition& condition, const IsoLoadFactors& factors, const LoadedCycle& cycle,
                         const std::vector<MeshParameter>& parameters, const ShaftMisalignment& shafts = {});

}  // namespace flankwright
