#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/rating/life_model.hpp"
#include "core/rating/load_signal.hpp"
#include "core/rating/material_strength.hpp"

namespace flankwright::studies {

/// One load of [load] spectrum.
struct SpectrumBin {
  double torque{not_given};          ///< on the pinion [N mm]; > 0 loads the pair's working flank, < 0 the other one; 0: no load, no damage
  double speed{not_given};           ///< of the pinion [rad/s], > 0; NaN: that of the load table
  double hours{not_given};           ///< [s], > 0
  double cycles{not_given};          ///< revolutions of the pinion, > 0; NaN: from hours and speed
  double temperature{not_given};     ///< of the oil [deg C]; NaN: that of the lubricant
  double dynamic_factor{not_given};  ///< K_v [-]; NaN: LifeTable::dynamic_factor
  double mesh_misalignment{0.0};     ///< added to that of the scene [mm]
  bool same_teeth{false};            ///< as Operation::same_teeth: `cycles` are those of the torque
};

/// How a torque over time becomes load cycles.
enum class LoadCounting { TimeAtLevel, Rainflow };

/// [load] spectrum as a table that names a file.
struct SpectrumSource {
  std::string file;    ///< of bins
  std::string signal;  ///< of a torque over time
  LoadCounting counting{LoadCounting::TimeAtLevel};
  int bins{20};
  double torque_factor{1.0};
  double hours{not_given};    ///< that the signal is repeated for [s]
  double repeats{not_given};  ///< NaN with hours NaN too: once
};

/// A signal as it was counted.
struct CountedSignal {
  std::string file;  ///< as found from the study
  LoadCounting counting{LoadCounting::TimeAtLevel};
  std::size_t samples{0};
  double duration{not_given};                                 ///< of the signal once [s]
  double repeats{1.0};                                        ///< [-]
  double least_torque{not_given}, largest_torque{not_given};  ///< on the pinion [N mm]
  LoadCount count{};                                          ///< of the signal once
  std::optional<LoadCount> reversed{};  ///< the same of the torque with the other sign, which loads the other flank; empty: none
};

/// An S-N curve as given: an endurance limit and either life factors of ISO 6336 or numbers of one's own.
struct GivenSnCurve {
  double limit{not_given};             ///< sigma_Hlim or sigma_Flim [MPa]; NaN: that of the named material, or none
  std::optional<LifeFactors> factors;  ///< where no exponent is given; empty: those of the named material, or of case-hardened steel
  double exponent{not_given}, knee{not_given}, exponent_beyond{not_given};
};

/// Materials as far as life goes, and [lubricant].
struct LifeTable {
  double application_factor{1.0}, dynamic_factor{1.0};  ///< as Operation's
  PerGear<int> meshes_per_revolution{0, 0};             ///< as Operation::meshes_per_revolution; 0: not given, those of the unit
  PerGear<std::optional<MaterialGrade>> grade;          ///< a material named by ISO 6336-5
  PerGear<GivenSnCurve> contact, root;
  bool has_lubricant{false};
  Lubricant lubricant;
  double roughness{not_given};             ///< Ra, mean of both flanks [mm]
  double bulk_temperature{not_given};      ///< [deg C]
  double permissible_film{not_given};      ///< lambda_GFP [-]
  double scuffing_temperature{not_given};  ///< theta_S [deg C]
};

}  // namespace flankwright::studies
