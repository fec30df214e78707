#include "core/compliance/shaft/bearing_law.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/compliance/shaft/shaft_data.hpp"

using namespace flankwright;

namespace {

constexpr double law_round_off = 1e-13;  // powers and their inverses

BearingLawData ball_bearing() {
  return {.table_force = {}, .table_deflection = {}, .type = BearingType::DeepGrooveBall, .elements = 10, .element_diameter = 12.7};
}
BearingLawData roller_bearing() {
  return {.table_force = {}, .table_deflection = {}, .type = BearingType::CylindricalRoller, .elements = 14, .element_length = 11};
}
BearingLawData table_of(std::vector<double> forces, std::vector<double> deflections) {
  return {.table_force = std::move(forces), .table_deflection = std::move(deflections)};
}

std::string first_law_problem(const BearingLawData& data) {
  const std::vector<InvalidInput> problems = find_problems(data);
  return problems.empty() ? "" : problems.front().field() + " = " + problems.front().value() + ": " + problems.front().allowed();
}

}  // namespace

TEST_CASE("Twice the load deflects a ball bearing by 2^(2/3) and a roller bearing by 2^0.9", "[core][compliance][shaft][bearing]") {
  const double force = GENERATE(20.0, 3000.0, 80000.0);
  const RadialLaw ball(ball_bearing()), roller(roller_bearing());
  CHECK(ball.deflection(2 * force) == Approx(std::pow(2.0, 2.0 / 3.0) * ball.deflection(force)).epsilon(law_round_off));
  CHECK(roller.deflection(2 * force) == Approx(std::pow(2.0, 0.9) * roller.deflection(force)).epsilon(law_round_off));
}

TEST_CASE("Bearings by type deflect as Palmgren's formulas do by hand", "[core][compliance][shaft][bearing][closed-form]") {
  // 5 kN on ten balls: Q = 2500 N; 4.36e-4 2500^(2/3) / 12.7^(1/3) = 4.36e-4 184.20 / 2.3331 mm.
  CHECK(RadialLaw(ball_bearing()).deflection(5000) == Approx(0.034423).epsilon(1e-4));  // four digits by hand
  // 14 kN on 14 rollers: Q = 5000 N; 7.68e-5 5000^0.9 / 11^0.8 = 7.68e-5 2133.4 / 6.8095 mm.
  CHECK(RadialLaw(roller_bearing()).deflection(14000) == Approx(0.024061).epsilon(1e-4));
  // A contact angle: 1/cos for the load of the element, and for the deflection by its approach.
  BearingLawData inclined = ball_bearing();
  inclined.type = BearingType::AngularContactBall;
  inclined.contact_angle = 25 * units::deg;
  const double factor = std::pow(std::cos(25 * units::deg), -5.0 / 3.0);
  CHECK(RadialLaw(inclined).deflection(5000) == Approx(factor * RadialLaw(ball_bearing()).deflection(5000)).epsilon(law_round_off));
}

TEST_CASE("Bearings by type are as stiff as rotor dynamics has them", "[core][compliance][shaft][bearing][reference]") {
  // k = 13e6 Z^(2/3) D^(1/3) F^(1/3) cos^(5/3) alpha, k = 1e9 Z^0.9 l^0.8 F^0.1 cos^1.9 alpha [Friswell et al., Dynamics of Rotating Machines, 2010,
  // pp. 182-185], in N and m, with Stribeck's 4.37 and 4.08 in place of 5. Model: constants of two digits.
  const double force = GENERATE(500.0, 20000.0), alpha = 20 * units::deg;
  BearingLawData ball = ball_bearing(), roller = roller_bearing();
  ball.type = BearingType::AngularContactBall;
  roller.type = BearingType::TaperedRoller;
  ball.contact_angle = roller.contact_angle = alpha;
  const RadialLaw of_balls(ball), of_rollers(roller);
  const double N_per_m = 1e-3;
  const double by_balls = 13e6 * std::pow(10.0, 2.0 / 3.0) * std::cbrt(0.0127 * force) * std::pow(std::cos(alpha), 5.0 / 3.0) * N_per_m;
  const double by_rollers = 1e9 * std::pow(14.0, 0.9) * std::pow(0.011, 0.8) * std::pow(force, 0.1) * std::pow(std::cos(alpha), 1.9) * N_per_m;
  CHECK(1 / of_balls.compliance(force) == Approx(by_balls * std::pow(4.37 / 5, 2.0 / 3.0)).epsilon(0.02));
  CHECK(1 / of_rollers.compliance(force) == Approx(by_rollers * std::pow(4.08 / 5, 0.9)).epsilon(0.03));
}

TEST_CASE("A table is met at its points, is linear between them and goes on along its last piece", "[core][compliance][shaft][bearing]") {
  // Not convex: the last piece is softer.
  const std::vector<double> forces{1000, 3000, 8000, 9000}, deflections{0.01, 0.02, 0.03, 0.05};
  const RadialLaw law(table_of(forces, deflections));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    CHECK(law.deflection(forces[i]) == Approx(deflections[i]).epsilon(law_round_off));
    CHECK(law.force(deflections[i]) == Approx(forces[i]).epsilon(law_round_off));
  }
  CHECK(law.deflection(500) == Approx(0.005).epsilon(law_round_off));  // from the origin
  CHECK(law.deflection(5500) == Approx(0.025).epsilon(law_round_off));
  CHECK(law.deflection(10000) == Approx(0.07).epsilon(law_round_off));
  CHECK(law.is_beyond_table(10000));
  CHECK_FALSE(law.is_beyond_table(9000));
  // The origin may be a point of the table.
  const RadialLaw with_origin(table_of({0, 1000, 3000, 8000, 9000}, {0, 0.01, 0.02, 0.03, 0.05}));
  for (const double force : {0.0, 400.0, 2000.0, 8500.0, 12000.0}) CHECK(with_origin.deflection(force) == law.deflection(force));
}

TEST_CASE("Force and deflection of a bearing are each other's inverse, and so are their slopes", "[core][compliance][shaft][bearing]") {
  const BearingLawData data = GENERATE(ball_bearing(), roller_bearing(), table_of({0, 2000, 5000}, {0, 0.02, 0.03}));
  const RadialLaw law(data);
  for (const double force : {300.0, 2500.0, 7000.0}) {
    const double deflection = law.deflection(force), step = 1e-5 * force;
    CHECK(law.force(deflection) == Approx(force).epsilon(law_round_off));
    CHECK(law.stiffness(deflection) * law.compliance(force) == Approx(1.0).epsilon(law_round_off));
    const double difference = (law.deflection(force + step) - law.deflection(force - step)) / (2 * step);
    CHECK(law.compliance(force) == Approx(difference).epsilon(1e-8));  // step^2 and round-off over the step
  }
}

TEST_CASE("Bearings that cannot be are refused by their key", "[core][compliance][shaft][bearing]") {
  using Catch::Contains;
  CHECK(first_law_problem({}).empty());
  CHECK(first_law_problem(ball_bearing()).empty());
  CHECK(first_law_problem(roller_bearing()).empty());
  CHECK_THAT(first_law_problem(table_of({1000, 900}, {0.01, 0.02})), Contains("force_table = 900: above 1000 N"));
  CHECK_THAT(first_law_problem(table_of({1000, 2000}, {0.01, 0.01})), Contains("deflection_table = 10: above 10 um"));
  CHECK_THAT(first_law_problem(table_of({-5, 2000}, {0.01, 0.02})), Contains("force_table = -5: 0 N or more"));
  CHECK_THAT(first_law_problem(table_of({1000, 2000}, {0.01})), Contains("deflection_table = 1 numbers: 2 numbers"));
  CHECK_THAT(first_law_problem(table_of({1000, 2000}, {})), Contains("deflection_table = (not given)"));
  CHECK_THAT(first_law_problem(table_of({0}, {0})), Contains("one point beyond the origin"));
  CHECK_THAT(first_law_problem(table_of({0, 1000}, {0.01, 0.02})), Contains("radial_clearance"));
  BearingLawData data = ball_bearing();
  data.elements = 0;
  CHECK_THAT(first_law_problem(data), Contains("elements = (not given): an integer of at least 3"));
  data = ball_bearing();
  data.element_diameter = not_given;
  CHECK_THAT(first_law_problem(data), Contains("element_diameter = (not given): above 0 mm"));
  data = ball_bearing();
  data.element_length = 10;
  CHECK_THAT(first_law_problem(data), Contains("element_length = 10: none"));
  data = ball_bearing();
  data.type = BearingType::AngularContactBall;
  CHECK_THAT(first_law_problem(data), Contains("contact_angle = (not given): 0 .. 60 deg"));
  data = roller_bearing();
  data.contact_angle = 0.1;
  CHECK_THAT(first_law_problem(data), Contains("contact_angle") && Contains("cylindrical_roller"));
  data = roller_bearing();
  data.table_force = data.table_deflection = {1.0};
  CHECK_THAT(first_law_problem(data), Contains("type = cylindrical_roller: none beside a table"));
  data = {};
  data.elements = 9;
  CHECK_THAT(first_law_problem(data), Contains("elements = 9: none"));
  CHECK_THROWS_AS(RadialLaw(data), InvalidInput);
  // Beside a constant stiffness.
  ShaftBearing bearing{.position = 10, .radial_stiffness = 5e5, .law = ball_bearing()};
  REQUIRE(find_yielding_problems(bearing).size() == 1);
  CHECK(find_yielding_problems(bearing).front().field() == "radial_stiffness");
}
