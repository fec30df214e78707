#include "core/rating/material_strength.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/base/error.hpp"

using namespace flankwright;

namespace {

constexpr std::array qualities{MaterialQuality::ML, MaterialQuality::MQ, MaterialQuality::ME};

/// The field that a stress number refuses; empty where it has a value.
template <class StressNumber>
std::string refused_field(const StressNumber& stress_number, const MaterialGrade& grade) {
  try {
    stress_number(grade);
  } catch (const InvalidInput& problem) {
    return problem.field();
  }
  return {};
}

}  // namespace

TEST_CASE("Case-hardened steel has the stress numbers that every gear book prints", "[core][rating][life]") {
  // ISO 6336-5, table 1.
  const auto contact = [](MaterialQuality quality) { return contact_stress_number({.quality = quality, .hardness = 720}); };
  const auto root = [](MaterialQuality quality, double core = not_given) {
    return root_stress_number({.quality = quality, .hardness = 720, .core_hardness = core});
  };
  CHECK(contact(MaterialQuality::ML) == 1300.0);
  CHECK(contact(MaterialQuality::MQ) == 1500.0);
  CHECK(contact(MaterialQuality::ME) == 1650.0);
  CHECK(root(MaterialQuality::ML) == 312.0);
  CHECK(root(MaterialQuality::MQ) == 425.0);
  CHECK(root(MaterialQuality::MQ, 29.0) == 425.0);
  CHECK(root(MaterialQuality::MQ, 30.0) == 500.0);
  CHECK(root(MaterialQuality::ME) == 525.0);
}

TEST_CASE("Better quality and greater hardness never bear less, and rows of one material meet", "[core][rating][life]") {
  const auto checked = [](const auto& stress_number) {
    int seen = 0;
    for (std::size_t k = 0; k < material_kind_count; ++k) {
      std::vector<double> of_lesser_quality(1000, 0.0);
      for (const MaterialQuality quality : qualities) {
        double softer = 0.0;
        for (int hardness = 100; hardness < 1000; ++hardness) {
          const MaterialGrade grade{.kind = static_cast<MaterialKind>(k), .quality = quality, .hardness = static_cast<double>(hardness)};
          if (!refused_field(stress_number, grade).empty()) continue;
          const double stress = stress_number(grade);
          CAPTURE(k, static_cast<int>(quality), hardness, stress);
          constexpr double rounding_of_table = 0.5;  // MPa, of B where two rows meet
          CHECK(stress >= softer - rounding_of_table);
          if (softer > 0.0) CHECK(stress <= softer + 2.3 + rounding_of_table);  // the steepest row has A = 2.213
          double& lesser = of_lesser_quality[static_cast<std::size_t>(hardness)];
          CHECK(stress >= lesser);
          lesser = softer = stress;
          ++seen;
        }
        CHECK(softer > 0.0);
      }
    }
    return seen;
  };
  CHECK(checked(contact_stress_number) > 3000);
  CHECK(checked(root_stress_number) > 3000);
}

TEST_CASE("A root bears less than half of what its flank bears", "[core][rating][life]") {
  for (std::size_t k = 0; k < material_kind_count; ++k) {
    for (const MaterialQuality quality : qualities) {
      for (double hardness = 100; hardness < 1000; hardness += 10) {
        const MaterialGrade grade{.kind = static_cast<MaterialKind>(k), .quality = quality, .hardness = hardness};
        if (!refused_field(contact_stress_number, grade).empty() || !refused_field(root_stress_number, grade).empty()) continue;
        CAPTURE(k, static_cast<int>(quality), hardness);
        CHECK(root_stress_number(grade) < 0.5 * contact_stress_number(grade));
      }
    }
  }
}

TEST_CASE("A hardness outside the table is refused with the range of its quality", "[core][rating][life]") {
  const auto problem_of = [](const auto& stress_number, const MaterialGrade& grade) -> std::string {
    try {
      stress_number(grade);
    } catch (const InvalidInput& problem) {
      return problem.field() + ": " + problem.allowed();
    }
    return {};
  };
  CHECK(problem_of(contact_stress_number, {.hardness = 659}) == "hardness: 660 .. 800 HV for sigma_Hlim of case_hardened MQ");
  CHECK(problem_of(contact_stress_number, {.hardness = 801}) == "hardness: 660 .. 800 HV for sigma_Hlim of case_hardened MQ");
  CHECK(problem_of(contact_stress_number, {.quality = MaterialQuality::ML, .hardness = 659}).empty());
  const MaterialGrade carbon{.kind = MaterialKind::ThroughHardenedCarbonSteel, .hardness = 120};
  CHECK(problem_of(root_stress_number, carbon).empty());
  CHECK(problem_of(contact_stress_number, carbon) == "hardness: 135 .. 210 HV for sigma_Hlim of through_hardened_carbon_steel MQ");
  const MaterialGrade nitrocarburised{.kind = MaterialKind::Nitrocarburised, .hardness = 700};  // two rows, one range
  CHECK(problem_of(root_stress_number, nitrocarburised) == "hardness: 300 .. 650 HV for sigma_Flim of nitrocarburised MQ");
  const MaterialGrade iron{.kind = MaterialKind::GreyCastIron, .hardness = 100};
  CHECK(problem_of(contact_stress_number, iron) == "hardness: 150 .. 240 HBW for sigma_Hlim of grey_cast_iron MQ");
  CHECK(refused_field(root_stress_number, {.hardness = 700, .core_hardness = 24}) == "core_hardness");
  CHECK(refused_field(root_stress_number, {.quality = MaterialQuality::ME, .hardness = 700, .core_hardness = 32}) == "core_hardness");
  CHECK(refused_field(contact_stress_number, {}) == "hardness");
}

TEST_CASE("A material's kind chooses the life factors", "[core][rating][life]") {
  CHECK(life_factors(MaterialKind::CaseHardened) == LifeFactors::CaseHardened);
  CHECK(life_factors(MaterialKind::InductionHardened) == LifeFactors::CaseHardened);
  CHECK(life_factors(MaterialKind::NitridedNitridingSteel) == LifeFactors::Nitrided);
  CHECK(life_factors(MaterialKind::GreyCastIron) == LifeFactors::Nitrided);
  CHECK(life_factors(MaterialKind::Nitrocarburised) == LifeFactors::Nitrocarburised);
  CHECK(life_factors(MaterialKind::ThroughHardenedCastAlloySteel) == LifeFactors::ThroughHardened);
}
