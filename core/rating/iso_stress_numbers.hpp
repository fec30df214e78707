#pragma once

#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Editions that the stress numbers follow, as results name them.
inline constexpr const char* contact_stress_edition = "ISO 6336-2:2019, f_ZCa = 1";
inline constexpr const char* root_stress_edition = "ISO 6336-3:2006, Y_DT = 1";

/// Nominal stress numbers of a pair under a torque, and the factors that they consist of. A rating by them multiplies load factors onto them.
struct IsoStressNumbers {
  // Contact [ISO 6336-2:2019]
  double Z_H{not_given}, Z_E{not_given}, Z_eps{not_given}, Z_beta{not_given};  ///< Z_E in sqrt(MPa)
  PerGear<double> single_pair{1.0, 1.0};                                       ///< Z_B, Z_D [-], >= 1
  double contact{not_given};                                                   ///< sigma_H0 at the pitch point [MPa]
  // Root [ISO 6336-3:2006]
  PerGear<double> Y_F{not_given, not_given}, Y_S{not_given, not_given};
  double Y_beta{not_given};
  PerGear<double> Y_B{1.0, 1.0};               ///< rim thickness factor, see rim_thickness_factor() [-]
  PerGear<double> root{not_given, not_given};  ///< sigma_F0 [MPa]

  /// sigma_H of a gear with K = K_A K_v K_Hbeta K_Halpha [MPa].
  double contact_stress(Member member, double K) const;
  /// sigma_F likewise, with K = K_A K_v K_Fbeta K_Falpha [MPa].
  double root_stress(Member member, double K) const { return root[member] * K; }
};

/// sigma_H0 = Z_H Z_E Z_eps Z_beta sqrt(F_t/(d_1 b) (u+1)/u),  Z_beta = 1/sqrt(cos beta)
/// sigma_F0 = F_t/(b m_n) Y_F Y_S Y_beta Y_B [ISO 6336-3:2006; nothing of the edition of 2019],  Y_beta = 1 - min(1, eps_beta) min(beta, 30 deg)/120 deg, load at the outer point of single pair contact (method B), with the fillet of the basic rack at the 30 deg tangent. The deep
/// tooth factor Y_DT is 1, which is on the safe side. F_t acts at the reference circle.
/// @param pinion_torque  [N mm], > 0
/// @param face_width     common [mm]
/// @param rim_thickness  of gears with a rim, from the root circle to the rim's underside [mm], > 0; NaN: a solid body
IsoStressNumbers iso_stress_numbers(const GearPair& pair, const PerGear<Material>& material, double pinion_torque, double face_width,
                                    const PerGear<double>& rim_thickness = {not_given, not_given});

/// Y_B of an external gear: with s_R/h_t, the rim's thickness over the tooth depth, 1 from 1.2 on and 1.6 ln(2.242 h_t/s_R) below it [ISO 6336-3:2006, rim thickness
/// factor] [-]. The standard advises against rims below 0.5 and has no formula there; this one goes on.
/// @param rim_thickness  s_R [mm], > 0; NaN: a solid body, which has 1
double rim_thickness_factor(const Gear& gear, double rim_thickness);

/// K_Fbeta = K_Hbeta^N_F, N_F = 1/(1 + h/b + (h/b)^2) with the tooth depth h and h/b at most 1/3 [ISO 6336-1:2006, 7.8] [-].
double root_face_load_factor(const GearPair& pair, double face_width, double K_Hbeta);

}  // namespace flankwright
