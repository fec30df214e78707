#pragma once

#include <Eigen/Core>

#include "core/load/cycle/mesh_cycle.hpp"
#include "core/rating/lubricant.hpp"

namespace flankwright {

/// What the lubricant film of a load case depends on beside its line loads.
struct FilmCondition {
  double speed{not_given};             ///< of the pinion [rad/s], > 0
  double oil_temperature{not_given};   ///< [deg C]
  double bulk_temperature{not_given};  ///< theta_M of the teeth [deg C]
  double friction{not_given};          ///< mu_m, mean coefficient of the mesh [-]
  double roughness{not_given};         ///< Ra, mean of both flanks [um], > 0
};

/// Bulk temperature of the teeth [ISO/TR 15144-1:2014, method B],
///
///     theta_M = theta_oil + 7400 (P mu_m H_v / (a b))^0.72 X_S/(1.2 X_Ca)
///
/// with P in kW, a and b in mm; X_Ca = 1, as without tip relief, which gives the highest temperature, and X_S = 1.2 of injected oil. H_v is Ohlendorf's. Mean friction
///
///     mu_m = 0.045 (F_bt / (b v_SigmaC rho_nC))^0.2 (1000 eta_oil)^-0.05 X_L 2.2 (Ra/rho_nC)^0.25
///
/// with all load factors 1, since local pressures have the load's distribution, and X_L = 1 of mineral oils, 0.8 of polyalphaolefins, 0.75 (6/v_SigmaC)^0.2 of
/// polyglycols.
/// @param force  normal to the flanks [N], > 0
/// @param given  speed, oil_temperature and roughness; a bulk_temperature that is given is kept
FilmCondition film_condition(const GearPair& pair, double face_width, double force, const Lubricant& lubricant, FilmCondition given);

/// Speeds of the flanks at a contact point, along the profile in the transverse section [m/s].
struct RollingSpeeds {
  double pinion, wheel;
};

/// omega rho_t of both flanks.
/// @param speed  of the pinion [rad/s]
RollingSpeeds rolling_speeds(const GearPair& pair, const ContactPoint& point, double speed);

/// A local number and its derivative by the line load.
struct LocalFilm {
  double ratio{not_given};              ///< lambda_GF, film thickness over Ra [-]; NaN without load or at a standstill
  double slope{not_given};              ///< by the line load [mm/N]
  double thickness{not_given};          ///< h [um]
  double flash_temperature{not_given};  ///< theta_fl of the uniform source [K]
};

/// Specific lubricant film thickness of one point under a line load [ISO/TR 15144-1:2014, now ISO/TS 6336-22, method A],
///
///     h      = 1600 rho_n G^0.6 U^0.7 W^-0.13 S^0.22                                              [um, rho_n in mm]
///     G      = 1e6 alpha(theta_M) E_r                  U = eta(theta_M) v_Sigma / (2000 E_r rho_n)
///     W      = 2 pi p^2 / E_r^2                        S = alpha(theta_B) eta(theta_B) / (alpha(theta_M) eta(theta_M))
///     theta_B = theta_M + theta_fl,   theta_fl = sqrt(pi)/2 mu_m 1e6 p |v_g| / (B_M (sqrt(v_r1) + sqrt(v_r2))) sqrt(8 rho_n p/(1000 E_r))
///
/// p is Hertz's pressure of the line load on the flank: that on a tip edge, whose radius is another, is no part of it. v_r = omega rho_t of either flank, v_g their
/// difference, v_Sigma their sum [m/s]. B_M = sqrt(45 * 7800 * 440) N/(m s^0.5 K) of steel. h is Dowson's and Higginson's line contact with the sliding factor S, and
/// theta_fl Blok's uniform source over Hertz's width, 1.6 % above the flash temperature of scuffing: see flash_temperature().
LocalFilm local_film(const GearPair& pair, double contact_modulus, const ContactPoint& point, double line_load, const Lubricant& lubricant,
                     const FilmCondition& condition);

}  // namespace flankwright
