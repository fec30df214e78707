#pragma once

#include <optional>

#include "core/load/cycle/mesh_cycle.hpp"
#include "core/rating/life_model.hpp"
#include "core/rating/lubricant.hpp"
#include "core/rating/operation.hpp"

namespace flankwright {

/// What the lubricant film of a load case depends on beside its line loads.
struct FilmCondition {
  double speed{not_given};             ///< of the pinion [rad/s], > 0
  double oil_temperature{not_given};   ///< [deg C]
  double bulk_temperature{not_given};  ///< theta_M of the teeth [deg C]
  double friction{not_given};          ///< mu_m, mean coefficient of the mesh [-]
  double roughness{not_given};         ///< Ra, mean of both flanks [um], > 0
  double overload{1.0};                ///< K_A K_v, by which line loads are multiplied [-], >= 1
};

/// Bulk temperature of the teeth [ISO/TR 15144-1:2014, method B],
///
///     theta_M = theta_oil + 7400 (P mu_m H_v / (a b))^0.72 X_S/(1.2 X_Ca)
///
/// with P in kW, a and b in mm; X_Ca = 1, as without tip relief, which gives the highest temperature, and X_S = 1.2 of injected oil. H_v is Ohlendorf's. Mean friction
///
///     mu_m = 0.045 (K_A K_v F_bt / (b v_SigmaC rho_nC))^0.2 (1000 eta_oil)^-0.05 X_L 2.2 (Ra/rho_nC)^0.25
///
/// without factors of load distribution, which local pressures have in them, and X_L = 1 of mineral oils, 0.8 of polyalphaolefins, 0.75 (6/v_SigmaC)^0.2 of
/// polyglycols.
/// @param force  normal to the flanks [N], > 0
/// @param given  speed, oil_temperature, roughness and overload; a bulk_temperature that is given is kept
FilmCondition film_condition(const GearPair& pair, double face_width, double force, const Lubricant& lubricant, FilmCondition given);

/// The oil of a load case, as far as it is known.
struct Oil {
  const Lubricant* lubricant;
  double temperature, roughness;  ///< [deg C], Ra [um]
};

/// With the load case's own temperature, else the lubricant's; nothing without a lubricant.
/// @param life  lives on
std::optional<Oil> oil_of(const LifeModel& life, const Operation& operation);

/// film_condition() of a load case; nothing without lubricant or speed.
/// @param force  of the mesh [N], > 0
std::optional<FilmCondition> film_condition_of(const MeshModel& model, const LifeModel& life, const Operation& operation, double force);

/// Speeds of the flanks at a contact point, along the profile in the transverse section [m/s].
struct RollingSpeeds {
  double pinion, wheel;
};

/// omega rho_t of both flanks.
/// @param speed  of the pinion [rad/s]
RollingSpeeds rolling_speeds(const GearPair& pair, const ContactPoint& point, double speed);

}  // namespace flankwright
