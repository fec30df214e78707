#include "core/contact/assembly/flank_assembly.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::deg;

TEST_CASE("An aligned wheel faces the pinion across the centre distance", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(20, 40, 10 * deg));
  const FlankAssembly assembly = scene_of(pair);
  CHECK((assembly.wheel_axes * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(-1, 0, 0)).norm() == 0.0);
  CHECK((assembly.wheel_axes * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(0, 0, 1)).norm() == 0.0);
  CHECK(assembly.wheel_centre == Eigen::Vector3d(pair.centre_distance, 0, 0));
  CHECK(assembly.speed_ratio() == 0.5);
}

TEST_CASE("Misalignment moves the wheel by its definition", "[core][contact]") {
  PairData data = pair_data(20, 40, 10 * deg);
  const WorkingFlank flank = GENERATE(WorkingFlank::Right, WorkingFlank::Left);
  data.working_flank = flank;
  const GearPair pair = make_gear_pair(data);
  Misalignment m;
  m.crossing = 3 * arcmin;
  m.intersecting = -2 * arcmin;
  m.centre_distance = 0.1;
  m.axial_offset = -0.7;
  const FlankAssembly assembly = scene_of(pair, m);
  // The wheel's axis leans by w x z, w = (crossing, intersecting, 0); the mirror image of a left flank crosses the
  // other way.
  const double crossing = flank == WorkingFlank::Right ? m.crossing : -m.crossing;
  const Eigen::Vector3d lean = assembly.wheel_axes.col(2) - Eigen::Vector3d::UnitZ();
  CHECK((lean - Eigen::Vector3d(m.intersecting, -crossing, 0)).norm() <= 1e-6);  // model: second order in the angles
  CHECK((assembly.wheel_axes.transpose() * assembly.wheel_axes - Eigen::Matrix3d::Identity()).norm() <= 1e-15);
  CHECK((assembly.wheel_centre - Eigen::Vector3d(pair.centre_distance + 0.1, 0, -0.7)).norm() <= 1e-13);
}

TEST_CASE("Pinion errors change base radius and helix by the report's equations 15 to 18", "[core][contact][reference]") {
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  const double small = 1e-6;  // rad; the equations are first order
  const double alpha_t = pair.transverse_pressure_angle, alpha_n = 20 * deg;
  const double r_p = pair.pinion.reference_radius, r_b = pair.pinion.base_radius;
  Misalignment pressure;
  pressure.pinion_pressure_angle = small;
  const Flank by_pressure = scene_of(pair, pressure).pinion;
  const double d_alpha_t = std::sin(2 * alpha_t) / std::sin(2 * alpha_n);                                         // eq. 15
  CHECK(std::abs((by_pressure.base_radius - r_b) / small / (-r_p * std::sin(alpha_t) * d_alpha_t) - 1) <= 1e-4);  // eq. 17
  const double lambda_b = 90 * deg - pair.base_helix_angle;
  const auto lambda_b_of = [](const Flank& flank) { return std::atan(1 / (std::abs(flank.helix_rate) * flank.base_radius)); };
  const double d_lambda_b = 0.5 * std::sin(2 * lambda_b) * std::tan(alpha_t) * d_alpha_t;  // eq. 16
  CHECK(std::abs((lambda_b_of(by_pressure) - lambda_b) / small / d_lambda_b - 1) <= 1e-4);
  Misalignment lead;
  lead.pinion_lead_angle = small;
  const Flank by_lead = scene_of(pair, lead).pinion;
  // Eq. 18 at r_p kept: dH/H = 2 d(lambda)/sin(2 lambda); here r_p follows as 1/sin(lambda), which takes cot(lambda)
  // d(lambda) off.
  const double lambda = reference::nasa_tm_107451::lead_angle;
  const double lead_ratio = pair.pinion.helix_rate / std::abs(by_lead.helix_rate) - 1;
  CHECK(std::abs(lead_ratio / small / (2 / std::sin(2 * lambda) - 1 / std::tan(lambda)) - 1) <= 1e-4);
}

TEST_CASE("An error that leaves no usable helicoid is refused", "[core][contact][invalid-input]") {
  const GearPair pair = make_gear_pair(pair_data(20, 40, 10 * deg));
  Misalignment m;
  m.pinion_pressure_angle = -21 * deg;
  CHECK_THROWS_AS(scene_of(pair, m), InvalidInput);
  m = {};
  m.pinion_lead_angle = -85 * deg;
  CHECK_THROWS_AS(scene_of(pair, m), InvalidInput);
  m = {};
  m.pinion_pressure_angle = -19.9 * deg;  // the base circle grows past the tip circle
  CHECK_NOTHROW(scene_of(pair, m));
}
