#include "core/rating/sn_curve.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"

using namespace flankwright;

TEST_CASE("The slopes of the life factors are the exponents that ISO 6336-6 lists", "[core][rating][life]") {
  // ISO 6336-6:2006, table on the exponent p by torque; it prints three decimals, the last of them two off. Contact stress grows as the root of the torque.
  constexpr double printed = 2e-3;
  CHECK(std::abs(contact_sn_curve(LifeFactors::CaseHardened, 1500).exponent / 2 - 6.610) < printed);
  CHECK(std::abs(contact_sn_curve(LifeFactors::ThroughHardened, 800).exponent / 2 - 6.610) < printed);
  CHECK(std::abs(contact_sn_curve(LifeFactors::Nitrided, 1200).exponent / 2 - 5.709) < printed);
  CHECK(std::abs(contact_sn_curve(LifeFactors::Nitrocarburised, 900).exponent / 2 - 15.715) < printed);
  CHECK(std::abs(root_sn_curve(LifeFactors::ThroughHardened, 600).exponent - 6.225) < printed);
  CHECK(std::abs(root_sn_curve(LifeFactors::CaseHardened, 1000).exponent - 8.738) < printed);
  CHECK(std::abs(root_sn_curve(LifeFactors::Nitrided, 800).exponent - 17.035) < printed);
  CHECK(std::abs(root_sn_curve(LifeFactors::Nitrocarburised, 700).exponent - 84.003) < printed);
}

TEST_CASE("A curve passes through the points of its life factor and has no jump", "[core][rating][life]") {
  constexpr double round_off = 1e-12;
  const SnCurve curve = contact_sn_curve(LifeFactors::CaseHardened, 1500.0);
  curve.validate();
  CHECK(curve.stress_for(1e5) == Approx(1.6 * 1500.0).epsilon(round_off));
  CHECK(curve.stress_for(5e7) == Approx(1500.0).epsilon(round_off));
  CHECK(curve.stress_for(1e10) == Approx(0.85 * 1500.0).epsilon(round_off));
  CHECK(curve.static_limit == Approx(2400.0).epsilon(round_off));
  for (const double cycles : {1e5, 3e6, 5e7, 2e8, 1e11}) {
    const double stress = curve.stress_for(cycles);
    CHECK(curve.cycles_to_failure(stress) == Approx(cycles).epsilon(1e-9));  // round-off times the exponent
    CHECK(curve.damage(stress).value * cycles == Approx(1.0).epsilon(1e-9));
  }
  // Fewer load cycles than those of the first point bear no more than the static limit: Z_NT <= 1.6 [ISO 6336-2:2006, table 2].
  for (const double cycles : {1.0, 1e3, 0.99e5}) CHECK(curve.stress_for(cycles) == curve.static_limit);
  CHECK(root_sn_curve(LifeFactors::CaseHardened, 1000.0).stress_for(1.0) == Approx(2500.0).epsilon(round_off));  // Y_NT <= 2.5
  const double below = std::nextafter(1500.0, 0.0);
  CHECK(curve.damage(below).value == Approx(curve.damage(1500.0).value).epsilon(round_off));
  CHECK(curve.damage(0.0).value == 0.0);
  CHECK(curve.damage(-3.0).value == 0.0);
  CHECK(std::isinf(curve.cycles_to_failure(0.0)));
}

TEST_CASE("The slope of the damage is that of central differences, on either side of the knee", "[core][rating][life]") {
  const SnCurve curve = root_sn_curve(LifeFactors::CaseHardened, 900.0);
  for (const double stress : {200.0, 700.0, 950.0, 1600.0}) {
    const double step = 1e-5 * stress;
    const double difference = (curve.damage(stress + step).value - curve.damage(stress - step).value) / (2.0 * step);
    CHECK(curve.damage(stress).slope == Approx(difference).epsilon(1e-6));  // curvature p^2 step^2
  }
}

TEST_CASE("A curve out of range names the field", "[core][rating][life]") {
  const auto field_of = [](const SnCurve& curve) {
    try {
      curve.validate();
    } catch (const InvalidInput& problem) {
      return problem.field();
    }
    return std::string();
  };
  CHECK(field_of({.limit = 0.0}) == "limit");
  CHECK(field_of({.limit = 100.0, .knee = -1.0}) == "knee");
  CHECK(field_of({.limit = 100.0, .exponent = 0.0}) == "exponent");
  CHECK(field_of({.limit = 100.0, .exponent_beyond = -2.0}) == "exponent_beyond");
  CHECK(field_of({.limit = 100.0, .static_limit = 100.0}) == "static_limit");
  CHECK(field_of({.limit = 100.0}).empty());
}
