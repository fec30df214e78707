#pragma once

#include "core/load/cycle/loaded_point.hpp"
#include "core/rating/film_condition.hpp"

namespace flankwright {

/// How the heat of friction is spread over the band of contact.
enum class HeatSource {
  Uniform,  ///< evenly, as ISO/TS 6336-22 has it in the film: coefficient 2/sqrt(pi) = 1.128
  Hertzian  ///< as Hertz's pressure, as ISO/TS 6336-20 has it: coefficient 1.11
};

/// Flash temperature theta_fl of one point of the flanks under load [Blok, Les temperatures de surface dans des conditions de graissage sous extreme
/// pression, 1937; ISO/TS 6336-20:2017],
///
///     theta_fl = X mu_m w |v_1 - v_2| / (B_M (sqrt(v_1) + sqrt(v_2)) sqrt(2 b_H))                        [K]
///
/// with the line load w, Hertz's half width b_H = 2 w/(pi p) of load and pressure, also on a tip edge, v = omega rho_t of either flank and
/// B_M = sqrt(45 * 7800 * 440) N/(m s^0.5 K) of steel. Both flanks are as hot as each other where they leave the band, and so fast that heat goes nowhere but inwards. w is the local load times K_A K_v, so the factors of load sharing and face
/// load are 1 [ISO/TS 6336-20 multiplies a nominal load by them]. The speeds are those of the transverse section, as the standard takes them for cylindrical gears:
/// across the inclined lines of a helical gear they are cos(beta_b) times as high, for which theta_fl would be 1/sqrt(cos(beta_b)) times as large.
/// @param condition  speed, overload and friction, from film_condition(); friction is the mesh's mean one
/// @return           0 without load or at a standstill
double flash_temperature(const GearPair& pair, const LoadedPoint& at, const FilmCondition& condition, HeatSource source);

/// Temperatures of one point and the derivatives of both.
struct LocalTemperature {
  double flash{not_given};    ///< theta_fl of the Hertzian source [K]
  double contact{not_given};  ///< theta_B = theta_M + theta_fl [deg C]
  /// By the line load at held pressure [K mm/N] and by the pressure at held load [K/MPa]; 0 without load, where theta_fl ~ (w p)^0.5 has none.
  double by_load{not_given}, by_pressure{not_given};
};

/// Contact temperature of one point [ISO/TS 6336-20:2017], with the bulk temperature theta_M of the condition.
LocalTemperature local_temperature(const GearPair& pair, const LoadedPoint& at, const FilmCondition& condition);

/// Safety against scuffing [ISO/TS 6336-20:2017],
///
///     S_B = (theta_S - theta_oil) / (theta_Bmax - theta_oil)                                              [-]
///
/// @param scuffing  theta_S of oil and material [deg C], above that of the oil
/// @param contact   theta_Bmax, the largest contact temperature [deg C], above that of the oil
inline double scuffing_safety(double scuffing, double contact, double oil) { return (scuffing - oil) / (contact - oil); }

}  // namespace flankwright
