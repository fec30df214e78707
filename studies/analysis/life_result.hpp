#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/rating/iso_stress_numbers.hpp"
#include "core/rating/life_model.hpp"

namespace flankwright::studies {

/// Estimated discretisation errors of a CaseLife, each in its figure's unit and >= 0; NaN: not estimated.
struct CaseLifeErrors {
  double loss_factor{not_given};                                        ///< [-]
  double loss_power{not_given};                                         ///< [W]
  double film{not_given}, micropitting_safety{not_given};               ///< [-]
  double flash_temperature{not_given}, contact_temperature{not_given};  ///< [K]
  double scuffing_safety{not_given};                                    ///< [-]
};

/// Loss, film, safety and damage of one load case. NaN: not asked for, or what it needs was not given.
struct CaseLife {
  std::size_t loaded{0};                                          ///< index into StudyResults::loaded
  double loss_factor{not_given};                                  ///< H_VL from the local loads [-]
  double friction{not_given};                                     ///< mu_mz by Schlenk [-]
  double power{not_given};                                        ///< transmitted [W]
  double loss_power{not_given};                                   ///< [W]
  Eigen::RowVectorXd loss_power_gradient{};                       ///< [W/unit]; empty where the cycle has no derivatives
  double film_friction{not_given};                                ///< mu_m of ISO/TS 6336-22, of the temperatures [-]
  double bulk_temperature{not_given};                             ///< of the teeth, of the film [deg C]
  double film{not_given};                                         ///< least lambda_GF [-]
  double film_of_flanks{not_given};                               ///< least lambda_GF where contact reaches no tip edge [-]
  double micropitting_safety{not_given};                          ///< film over the permissible one [-]
  double flash_temperature{not_given};                            ///< largest theta_fl [K]
  double contact_temperature{not_given};                          ///< theta_Bmax [deg C]
  double flank_temperature{not_given};                            ///< likewise where contact reaches no tip edge [deg C]
  double hottest_z{not_given}, hottest_pinion_radius{not_given};  ///< where that is [mm]
  double scuffing_safety{not_given};                              ///< S_B [-]
  CaseLifeErrors errors{};                                        ///< of these
  std::vector<Eigen::VectorXd> flash;                             ///< theta_fl at the points of each mesh position [K]; empty: not known
  std::vector<Eigen::VectorXd> film_at_points;                    ///< lambda_GF likewise [-]; NaN where a point has no load
  PerGear<double> contact_safety{not_given,
                                 not_given};  ///< stress that is borne for the case's load cycles, or for ever, over the peak contact stress [-]
  PerGear<double> root_safety{not_given, not_given};  ///< likewise of the largest root stress [-]
  IsoStressNumbers iso{};
  bool K_from_contact{false};  ///< load factors of the loaded contact, without spikes; else those of ISO 6336-1, method C
  double K_H{not_given}, K_F{not_given};
  PerGear<double> iso_contact{not_given, not_given}, iso_root{not_given, not_given};                ///< sigma_H, sigma_F [MPa]
  PerGear<double> iso_contact_safety{not_given, not_given}, iso_root_safety{not_given, not_given};  ///< [-]
  PerGear<double> contact_damage{not_given, not_given};  ///< of this case at the point where the spectrum damages the flank most [-]
  PerGear<double> root_damage{not_given, not_given};     ///< likewise of the fillet [-]
};

/// The point of a gear that a spectrum damages most.
struct DamagedPoint {
  double damage{0.0};                      ///< sum over the spectrum [-]
  Eigen::RowVectorXd gradient{};           ///< of the damage at this point, 1 x m; empty where the cycles have no derivatives
  double damage_error{not_given};          ///< estimated discretisation error [-]; NaN: not estimated
  double z{not_given}, radius{not_given};  ///< of a flank: on this gear [mm]
  double along{not_given};                 ///< of a fillet: as RootStation::along [-]
  bool exceeds_static_limit{false};        ///< a load case exceeds the static limit somewhere on the gear
};

/// The point of each gear; nothing where its damage is not known.
using DamagedPoints = PerGear<std::optional<DamagedPoint>>;

/// The damage at one point of the flanks.
struct FlankDamage {
  double z, pinion_radius, wheel_radius;         ///< [mm]
  double phase;                                  ///< of the mesh position
  int tooth;                                     ///< pair that touches there
  PerGear<double> damage{not_given, not_given};  ///< [-]
};

/// A load spectrum in one scene, for one design.
struct SpectrumLife {
  std::string scene, design;
  std::vector<std::size_t> cases;  ///< indices into StudyLife::cases
  DamagedPoints contact, root;
  std::vector<FlankDamage> map;  ///< of all contact points; empty without a curve of the flanks
};

struct StudyLife {
  double ohlendorf{not_given};  ///< H_V [-]
  std::vector<CaseLife> cases;  ///< one for each of the results' loaded entries that is usable
  std::vector<SpectrumLife> spectra;
  std::set<std::string> not_summed;  ///< of which spectrum the damage has no sum, and why: a sentence each

  /// Of an entry of StudyResults::loaded; null where it has none.
  const CaseLife* find(std::size_t loaded) const {
    const auto found = std::ranges::find(cases, loaded, &CaseLife::loaded);
    return found == cases.end() ? nullptr : &*found;
  }
};

}  // namespace flankwright::studies
