#pragma once

#include <string_view>

#include "core/gear/gear_data.hpp"
#include "core/rating/sn_curve.hpp"

namespace flankwright {

/// Groups of materials and their heat treatment [ISO 6336-5:2016, table 1], with the abbreviation there.
enum class MaterialKind {
  NormalisedSteel,                 ///< St, wrought low-carbon
  NormalisedCastSteel,             ///< St (cast)
  MalleableCastIron,               ///< GTS (perl.), black
  NodularCastIron,                 ///< GGG, pearlitic or bainitic
  GreyCastIron,                    ///< GG
  ThroughHardenedCarbonSteel,      ///< V, wrought
  ThroughHardenedAlloySteel,       ///< V, wrought
  ThroughHardenedCastCarbonSteel,  ///< V (cast)
  ThroughHardenedCastAlloySteel,   ///< V (cast)
  CaseHardened,                    ///< Eh, wrought
  InductionHardened,               ///< IF, flame or induction, wrought and cast
  NitridedNitridingSteel,          ///< NT (nitr.)
  NitridedThroughHardeningSteel,   ///< NV (nitr.)
  Nitrocarburised                  ///< NV (nitrocar.), wrought
};
constexpr std::size_t material_kind_count = 14;

/// "normalised_steel", "case_hardened" ...
std::string_view to_string(MaterialKind kind);

/// Demands on material and heat treatment: low, those of experienced makers at moderate cost, high [ISO 6336-5:2016].
enum class MaterialQuality { ML, MQ, ME };

/// "ML", "MQ", "ME".
std::string_view to_string(MaterialQuality quality);

struct MaterialGrade {
  MaterialKind kind{MaterialKind::CaseHardened};
  MaterialQuality quality{MaterialQuality::MQ};
  double hardness{not_given};       ///< of the surface, on hardness_scale(kind)
  double core_hardness{not_given};  ///< HRC; counts for the root of case-hardened MQ alone, NaN: 25, the least of that quality
};

/// "HBW" for normalised steels and cast irons, else "HV".
std::string_view hardness_scale(MaterialKind kind);

/// Nominal stress numbers [ISO 6336-5:2016, 5.5 and table 1],
///
///     sigma_Hlim, sigma_Flim = A x + B     [MPa],     x = hardness of the surface
///
/// for standard reference test gears and 1 % probability of damage: the factors of lubricant, speed, roughness, work hardening and size are 1. The range of x
/// belongs to kind, quality and stress. The root of case-hardened steel of quality MQ bears 425 with a core of at least 25 HRC and 500 with one of at least
/// 30 HRC; the 461 of a core of 25 HRC with high hardenability is left out.
///
/// A, B and the ranges agree, row by row, with one public transcription of the table. The rows of 570 .. 615 HV
/// of induction-hardened roots (369) and of 450 .. 650 HV of nitrocarburised steel (950, 388) were not in it; they continue their neighbours without a jump.
/// @throws InvalidInput "hardness" or "core_hardness", with the range
double contact_stress_number(const MaterialGrade& grade);
double root_stress_number(const MaterialGrade& grade);

/// The life factors of a kind [ISO 6336-2:2006, table 2; ISO 6336-3:2006, table 1]. Grey cast iron has those of nitrided steel.
LifeFactors life_factors(MaterialKind kind);

}  // namespace flankwright
