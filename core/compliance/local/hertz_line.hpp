#pragma once

#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Contact modulus E' of two bodies, 1/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 [MPa]; 113 200 MPa for steel on steel.
/// @throws InvalidInput naming the property outside its range ("youngs_modulus", "poissons_ratio")
double contact_modulus(const Material& first, const Material& second);

/// Checks a material's own range: E > 0 and 0 <= nu < 0.5. Throws InvalidInput as contact_modulus().
void validate(const Material& material);

/// Hertzian line contact of two cylinders, and how it grows with the load.
struct HertzLine {
  double half_width{not_given};           ///< L [mm]
  double peak_pressure{not_given};        ///< p_0 [MPa]
  double half_width_slope{not_given};     ///< dL/dw [mm^2/N]; infinite at w = 0
  double peak_pressure_slope{not_given};  ///< dp_0/dw [1/mm]; infinite at w = 0
};

/// Half width and peak pressure of a line contact [Johnson, Contact Mechanics, 1985, section 4.2(c)],
///
///     L = sqrt(4 w R / (pi E')),   p_0 = sqrt(w E' / (pi R)) = 2 w / (pi L),
///
/// both growing as sqrt(w). For two gears of one material L is Haddad's eq. 1.31. Valid for smooth, dry, elastic bodies
/// with L much smaller than R. Free edges of a tooth are not modelled; FreeEnd is about the end faces.
///
/// @param line_load        w [N per mm of contact line], >= 0
/// @param relative_radius  R, 1/R = 1/R_1 + 1/R_2, in the normal section [mm], > 0
/// @param contact_modulus  E' [MPa], > 0
/// @throws InvalidInput    naming the argument outside its range
HertzLine hertz_line(double line_load, double relative_radius, double contact_modulus);

}  // namespace flankwright
