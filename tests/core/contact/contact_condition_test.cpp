#include "core/contact/unloaded/contact_condition.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;

TEST_CASE("The wheel angle through a point is the flank's own inverse, and its gradient that of differences", "[core][contact][independent]") {
  Random random(8);
  for (int i = 0; i < 30; ++i) {
    const PairData data = random_pair_data(random);
    if (!find_problems(data).empty()) continue;
    const GearPair pair = make_gear_pair(data);
    const Misalignment misalignment = random_misalignment(random);
    Modification pinion = random_modification(random, pair.pinion), wheel = random_modification(random, pair.wheel);
    // smooth, so that differences mean something
    pinion.tip_relief = wheel.tip_relief = pinion.root_relief = wheel.root_relief = {};
    pinion.end_relief = wheel.end_relief = {};
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    const double phi1 = random(-0.1, 0.1), h = 1e-4;
    const ContactCondition here(scene, 1, phi1);
    const double rho = 0.5 * (scene.pinion.lowest_roll() + scene.pinion.highest_roll());
    const double z = random(-0.3, 0.3) * std::min(scene.pinion.face.half(), scene.wheel.face.half());
    const double angle = wheel_angle(scene, 1, phi1, rho, z);
    if (std::isinf(angle)) continue;
    const FlankContact contact = here.at(rho, z);
    CAPTURE(i);
    CHECK(std::abs(here.phi2(contact) - angle) <= 1e-14);  // round-off
    const auto difference = [&](double d_rho, double d_z, double d_phi1) {
      return (wheel_angle(scene, 1, phi1 + d_phi1, rho + d_rho, z + d_z) - wheel_angle(scene, 1, phi1 - d_phi1, rho - d_rho, z - d_z)) / (2 * h);
    };
    constexpr double kDiscretisation = 1e-8;  // h^2 times third derivatives, and round-off over h
    CHECK(std::abs(difference(h, 0, 0) - contact.angle.rho) <= kDiscretisation);
    CHECK(std::abs(difference(0, h, 0) - contact.angle.z) <= kDiscretisation);
    CHECK(std::abs(difference(0, 0, h) - contact.angle.phi1) <= 1e-6);
  }
}

TEST_CASE("Beyond the wheel's face a section follows its end", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(22, 51, 17 * units::deg, 0.0, 0.0, 40.0, 30.0));
  Misalignment misalignment;
  misalignment.crossing = 5 * units::arcmin;
  const FlankAssembly scene = scene_of(pair, misalignment);
  const ContactCondition here(scene, 0, 0.01);
  const double rho = 0.5 * (scene.pinion.lowest_roll() + scene.pinion.highest_roll());
  for (const double z : {-18.0, 18.0}) {
    const FlankContact contact = here.at(rho, z);
    CHECK(contact.on_wheel_end);
    CHECK(std::abs(std::abs(contact.wheel_z) - 15.0) <= 1e-13);  // round-off
    CHECK(std::abs(contact.z) < 16.0);
    // Along the end.
    const FlankContact next = here.at(rho + 1e-4, z), last = here.at(rho - 1e-4, z);
    CHECK(std::abs((here.phi2(next) - here.phi2(last)) / 2e-4 - contact.angle.rho) <= 1e-9);  // discretisation
    CHECK(std::abs(here.axial_gradient(contact).rho) <= 1e-12);
  }
}
