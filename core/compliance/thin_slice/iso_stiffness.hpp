#pragma once

#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Mesh stiffness of a pair by ISO 6336-1, method B. Stiffnesses and q' in the standard's units: N/(mm um) and mm um/N,
/// per mm of face width, in the transverse section along the line of action.
struct IsoStiffness {
  double virtual_teeth_pinion{not_given};  ///< z_n1 = z_1 / (cos^2 beta_b cos beta)
  double virtual_teeth_wheel{not_given};   ///< z_n2
  double q_prime{not_given};               ///< q', minimum flexibility of a pair of teeth [mm um/N]
  double c_theoretical{not_given};         ///< c'_th = 1/q' [N/(mm um)]
  double correction_factor{not_given};     ///< C_M = 0.8
  double blank_factor{not_given};          ///< C_R = 1, solid blanks
  double rack_factor{not_given};           ///< C_B, mean of both racks
  double material_factor{not_given};       ///< E/E_steel, E = 2 E_1 E_2/(E_1 + E_2), E_steel = 206 000 MPa
  double c_prime{not_given};               ///< c', maximum stiffness of a single pair of teeth [N/(mm um)]
  double c_gamma{not_given};               ///< c_gamma_alpha, mean mesh stiffness [N/(mm um)]
  /// c'_th C_M C_R C_B E/E_steel [N/(mm um)]: c' without its factor cos(beta), per mm of contact line and normal to the
  /// flank.
  double normal_section{not_given};
  /// The standard's formula for q' covers the pair: x_1 >= x_2 with the smaller gear as 1, -0.5 <= x_1 + x_2 <= 2, helix angle at most 45 deg. The
  /// numbers are given outside it too, as an extrapolation.
  bool within_range{false};
  /// The formula for c_gamma_alpha is stated for eps_alpha >= 1.2; below, it may be up to 10 % too high.
  bool mean_within_range{false};
};

/// q' of ISO 6336-1 from the virtual numbers of teeth and the profile shifts, gear 1 being the pinion, that is, the smaller gear [mm um/N]:
///
///     q' = 0.04723 + 0.15551/z_n1 + 0.25791/z_n2 - 0.00635 x_1 - 0.11654 x_1/z_n1
///          - 0.00193 x_2 - 0.24188 x_2/z_n2 + 0.00529 x_1^2 + 0.00182 x_2^2
double iso_flexibility(double virtual_teeth_pinion, double virtual_teeth_wheel, double shift_pinion, double shift_wheel);

/// c' = C_M C_R C_B cos(beta) (E/E_steel) / q' and c_gamma_alpha = c' (0.75 eps_alpha + 0.25) [ISO 6336-1, method B],
/// with C_B = (1 + 0.5 (1.2 - h_fP/m_n)) (1 - 0.02 (20 deg - alpha_n)).
///
/// ISO's gear 1 is the smaller gear, whichever a pair calls its pinion; of equal ones that with the larger (generating) profile shift. Valid
/// for solid blanks and specific loads of 100 N/mm and more; the standard's allowance for lighter loads is not applied.
/// @throws InvalidInput where a material is out of range
IsoStiffness iso_stiffness(const GearPair& pair, const Material& pinion, const Material& wheel);

}  // namespace flankwright
