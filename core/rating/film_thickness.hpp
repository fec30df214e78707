#pragma once

#include "core/load/cycle/loaded_point.hpp"
#include "core/rating/film_condition.hpp"

namespace flankwright {

/// The film at one point, and the derivatives of its ratio.
struct LocalFilm {
  double ratio{not_given};              ///< lambda_GF, film thickness over Ra [-]; NaN without load or at a standstill
  double by_load{not_given};            ///< by the line load at held pressure [mm/N]
  double by_pressure{not_given};        ///< by the pressure at held load [1/MPa]
  double thickness{not_given};          ///< h [um]
  double flash_temperature{not_given};  ///< theta_fl of the uniform source [K]
};

/// Specific lubricant film thickness of one point under load [ISO/TR 15144-1:2014, now ISO/TS 6336-22, method A],
///
///     h      = 1600 rho_n G^0.6 U^0.7 W^-0.13 S^0.22                                              [um, rho_n in mm]
///     G      = 1e6 alpha(theta_M) E_r                  U = eta(theta_M) v_Sigma / (2000 E_r rho_n)
///     W      = 2 pi p^2 / E_r^2                        S = alpha(theta_B) eta(theta_B) / (alpha(theta_M) eta(theta_M))
///     theta_B = theta_M + theta_fl
///
/// p is the largest pressure at the point times sqrt(K_A K_v), p_dyn of the standard, rho_n the relative radius of curvature of the flanks, and v_Sigma the sum of
/// v_r = omega rho_t of both [m/s]. h is Dowson's and Higginson's line contact with the sliding factor S. theta_fl is flash_temperature() of the uniform source.
///
/// Departures: the standard leaves tip edges out, here contact on one has the film of its pressure. Above 300 deg C, where the standard's expression of alpha nears its
/// zero, the logarithm of alpha eta goes on in a straight line.
LocalFilm local_film(const GearPair& pair, double contact_modulus, const LoadedPoint& at, const Lubricant& lubricant, const FilmCondition& condition);

}  // namespace flankwright
