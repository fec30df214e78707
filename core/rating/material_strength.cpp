#include "core/rating/material_strength.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "core/base/error.hpp"

namespace flankwright {

namespace {

using enum MaterialKind;
using enum MaterialQuality;

/// One row of table 1: sigma = A x + B for low <= x <= high.
struct StressNumberRow {
  MaterialKind kind;
  MaterialQuality least, most;
  double A, B, low, high;
};

constexpr std::array contact_rows{
    StressNumberRow{NormalisedSteel, ML, MQ, 1.000, 190, 110, 210},
    StressNumberRow{NormalisedSteel, ME, ME, 1.520, 250, 110, 210},
    StressNumberRow{NormalisedCastSteel, ML, MQ, 0.986, 131, 140, 210},
    StressNumberRow{NormalisedCastSteel, ME, ME, 1.143, 237, 140, 210},
    StressNumberRow{MalleableCastIron, ML, MQ, 1.371, 143, 135, 250},
    StressNumberRow{MalleableCastIron, ME, ME, 1.333, 267, 175, 250},
    StressNumberRow{NodularCastIron, ML, MQ, 1.434, 211, 175, 300},
    StressNumberRow{NodularCastIron, ME, ME, 1.500, 250, 200, 300},
    StressNumberRow{GreyCastIron, ML, MQ, 1.033, 132, 150, 240},
    StressNumberRow{GreyCastIron, ME, ME, 1.465, 122, 175, 275},
    StressNumberRow{ThroughHardenedCarbonSteel, ML, ML, 0.963, 283, 135, 210},
    StressNumberRow{ThroughHardenedCarbonSteel, MQ, MQ, 0.925, 360, 135, 210},
    StressNumberRow{ThroughHardenedCarbonSteel, ME, ME, 0.838, 432, 135, 210},
    StressNumberRow{ThroughHardenedAlloySteel, ML, ML, 1.313, 188, 200, 360},
    StressNumberRow{ThroughHardenedAlloySteel, MQ, MQ, 1.313, 373, 200, 360},
    StressNumberRow{ThroughHardenedAlloySteel, ME, ME, 2.213, 260, 200, 390},
    StressNumberRow{ThroughHardenedCastCarbonSteel, ML, MQ, 0.831, 300, 130, 215},
    StressNumberRow{ThroughHardenedCastCarbonSteel, ME, ME, 0.951, 345, 130, 215},
    StressNumberRow{ThroughHardenedCastAlloySteel, ML, MQ, 1.276, 298, 200, 360},
    StressNumberRow{ThroughHardenedCastAlloySteel, ME, ME, 1.350, 356, 200, 360},
    StressNumberRow{CaseHardened, ML, ML, 0.0, 1300, 600, 800},
    StressNumberRow{CaseHardened, MQ, MQ, 0.0, 1500, 660, 800},
    StressNumberRow{CaseHardened, ME, ME, 0.0, 1650, 660, 800},
    StressNumberRow{InductionHardened, ML, ML, 0.740, 602, 485, 615},
    StressNumberRow{InductionHardened, MQ, MQ, 0.541, 882, 500, 615},
    StressNumberRow{InductionHardened, ME, ME, 0.505, 1013, 500, 615},
    StressNumberRow{NitridedNitridingSteel, ML, ML, 0.0, 1125, 650, 900},
    StressNumberRow{NitridedNitridingSteel, MQ, MQ, 0.0, 1250, 650, 900},
    StressNumberRow{NitridedNitridingSteel, ME, ME, 0.0, 1450, 650, 900},
    StressNumberRow{NitridedThroughHardeningSteel, ML, ML, 0.0, 788, 450, 650},
    StressNumberRow{NitridedThroughHardeningSteel, MQ, MQ, 0.0, 998, 450, 650},
    StressNumberRow{NitridedThroughHardeningSteel, ME, ME, 0.0, 1217, 450, 650},
    StressNumberRow{Nitrocarburised, ML, ML, 0.0, 650, 300, 650},
    StressNumberRow{Nitrocarburised, MQ, ME, 1.167, 425, 300, 450},
    StressNumberRow{Nitrocarburised, MQ, ME, 0.0, 950, 450, 650},
};

constexpr std::array root_rows{
    StressNumberRow{NormalisedSteel, ML, MQ, 0.455, 69, 110, 210},
    StressNumberRow{NormalisedSteel, ME, ME, 0.386, 147, 110, 210},
    StressNumberRow{NormalisedCastSteel, ML, MQ, 0.313, 62, 140, 210},
    StressNumberRow{NormalisedCastSteel, ME, ME, 0.254, 137, 140, 210},
    StressNumberRow{MalleableCastIron, ML, MQ, 0.345, 77, 135, 250},
    StressNumberRow{MalleableCastIron, ME, ME, 0.403, 128, 175, 250},
    StressNumberRow{NodularCastIron, ML, MQ, 0.350, 119, 175, 300},
    StressNumberRow{NodularCastIron, ME, ME, 0.380, 134, 200, 300},
    StressNumberRow{GreyCastIron, ML, MQ, 0.256, 8, 150, 240},
    StressNumberRow{GreyCastIron, ME, ME, 0.200, 53, 175, 275},
    StressNumberRow{ThroughHardenedCarbonSteel, ML, ML, 0.250, 108, 115, 215},
    StressNumberRow{ThroughHardenedCarbonSteel, MQ, MQ, 0.240, 163, 115, 215},
    StressNumberRow{ThroughHardenedCarbonSteel, ME, ME, 0.283, 202, 115, 215},
    StressNumberRow{ThroughHardenedAlloySteel, ML, ML, 0.423, 104, 200, 360},
    StressNumberRow{ThroughHardenedAlloySteel, MQ, MQ, 0.425, 187, 200, 360},
    StressNumberRow{ThroughHardenedAlloySteel, ME, ME, 0.358, 231, 200, 390},
    StressNumberRow{ThroughHardenedCastCarbonSteel, ML, MQ, 0.224, 117, 130, 215},
    StressNumberRow{ThroughHardenedCastCarbonSteel, ME, ME, 0.286, 167, 130, 215},
    StressNumberRow{ThroughHardenedCastAlloySteel, ML, MQ, 0.364, 161, 200, 360},
    StressNumberRow{ThroughHardenedCastAlloySteel, ME, ME, 0.356, 186, 200, 360},
    StressNumberRow{CaseHardened, ML, ML, 0.0, 312, 600, 800},
    StressNumberRow{CaseHardened, MQ, MQ, 0.0, 425, 660, 800},
    StressNumberRow{CaseHardened, ME, ME, 0.0, 525, 660, 800},
    StressNumberRow{InductionHardened, ML, ML, 0.305, 76, 485, 615},
    StressNumberRow{InductionHardened, MQ, MQ, 0.138, 290, 500, 570},
    StressNumberRow{InductionHardened, MQ, MQ, 0.0, 369, 570, 615},
    StressNumberRow{InductionHardened, ME, ME, 0.271, 237, 500, 615},
    StressNumberRow{NitridedNitridingSteel, ML, ML, 0.0, 270, 650, 900},
    StressNumberRow{NitridedNitridingSteel, MQ, MQ, 0.0, 420, 650, 900},
    StressNumberRow{NitridedNitridingSteel, ME, ME, 0.0, 468, 650, 900},
    StressNumberRow{NitridedThroughHardeningSteel, ML, ML, 0.0, 258, 450, 650},
    StressNumberRow{NitridedThroughHardeningSteel, MQ, MQ, 0.0, 363, 450, 650},
    StressNumberRow{NitridedThroughHardeningSteel, ME, ME, 0.0, 432, 450, 650},
    StressNumberRow{Nitrocarburised, ML, ML, 0.0, 224, 300, 650},
    StressNumberRow{Nitrocarburised, MQ, ME, 0.653, 94, 300, 450},
    StressNumberRow{Nitrocarburised, MQ, ME, 0.0, 388, 450, 650},
};

constexpr StressNumberRow hard_core{CaseHardened, MQ, MQ, 0.0, 500, 660, 800};
constexpr double least_core = 25.0, least_hard_core = 30.0;  // HRC

double stress_number(std::span<const StressNumberRow> rows, const MaterialGrade& grade, const char* stress) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const StressNumberRow& row : rows) {
    if (row.kind != grade.kind || grade.quality < row.least || grade.quality > row.most) continue;
    if (std::isgreaterequal(grade.hardness, row.low) && std::islessequal(grade.hardness, row.high)) return row.A * grade.hardness + row.B;
    low = std::fmin(low, row.low);
    high = std::fmax(high, row.high);
  }
  throw InvalidInput("hardness", in_words(grade.hardness),
                     in_words(low) + " .. " + in_words(high) + " " + std::string(hardness_scale(grade.kind)) + " for " + stress + " of " +
                         std::string(to_string(grade.kind)) + " " + std::string(to_string(grade.quality)));
}

}  // namespace

std::string_view to_string(MaterialKind kind) {
  constexpr std::array<std::string_view, material_kind_count> names{"normalised_steel",
                                                                    "normalised_cast_steel",
                                                                    "malleable_cast_iron",
                                                                    "nodular_cast_iron",
                                                                    "grey_cast_iron",
                                                                    "through_hardened_carbon_steel",
                                                                    "through_hardened_alloy_steel",
                                                                    "through_hardened_cast_carbon_steel",
                                                                    "through_hardened_cast_alloy_steel",
                                                                    "case_hardened",
                                                                    "induction_hardened",
                                                                    "nitrided_nitriding_steel",
                                                                    "nitrided_through_hardening_steel",
                                                                    "nitrocarburised"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view to_string(MaterialQuality quality) {
  constexpr std::array<std::string_view, 3> names{"ML", "MQ", "ME"};
  return names[static_cast<std::size_t>(quality)];
}

std::string_view hardness_scale(MaterialKind kind) { return kind <= GreyCastIron ? "HBW" : "HV"; }

double contact_stress_number(const MaterialGrade& grade) { return stress_number(contact_rows, grade, "sigma_Hlim"); }

double root_stress_number(const MaterialGrade& grade) {
  if (std::isnan(grade.core_hardness)) return stress_number(root_rows, grade, "sigma_Flim");
  if (grade.kind != CaseHardened || grade.quality != MQ) {
    throw InvalidInput("core_hardness", in_words(grade.core_hardness), "a number for case_hardened MQ alone");
  }
  if (!(grade.core_hardness >= least_core))
    throw InvalidInput("core_hardness", in_words(grade.core_hardness), "at least 25 HRC for case_hardened MQ");
  if (grade.core_hardness < least_hard_core) return stress_number(root_rows, grade, "sigma_Flim");
  return stress_number({&hard_core, 1}, grade, "sigma_Flim");
}

LifeFactors life_factors(MaterialKind kind) {
  switch (kind) {
    case GreyCastIron:
    case NitridedNitridingSteel:
    case NitridedThroughHardeningSteel:
      return LifeFactors::Nitrided;
    case CaseHardened:
    case InductionHardened:
      return LifeFactors::CaseHardened;
    case Nitrocarburised:
      return LifeFactors::Nitrocarburised;
    default:
      return LifeFactors::ThroughHardened;
  }
}

}  // namespace flankwright
