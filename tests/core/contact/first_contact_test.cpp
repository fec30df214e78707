#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::deg;

namespace {

constexpr double kRoundOffAngle = 1e-12;  // rad

}  // namespace

TEST_CASE("No point of the pinion's flank lies inside the wheel's at first contact", "[core][contact][independent]") {
  Random random(20260101);
  int scenes = 0;
  while (scenes < 30) {
    const PairData data = random_pair_data(random);
    if (!find_problems(data).empty()) continue;
    ++scenes;
    const GearPair pair = make_gear_pair(data);
    const Misalignment misalignment = random_misalignment(random);
    const Modification pinion = random_modification(random, pair.pinion), wheel = random_modification(random, pair.wheel);
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    const double phi1 = random(-0.5, 0.5) * (pair.total_contact_ratio() + 0.3) * 2 * units::pi / data.pinion.teeth;
    const ToothContact contact = find_tooth_contact(scene, 0, phi1);
    constexpr int kGrid = 200;
    const double highest = highest_on_grid(scene, phi1, kGrid);
    CAPTURE(scenes, phi1, to_string(contact.kind), contact.pinion_radius, contact.pinion_z, highest - contact.phi2);
    if (!contact.exists()) {
      CHECK(highest == -std::numeric_limits<double>::infinity());
      continue;
    }
    CHECK(highest <= contact.phi2 + kRoundOffAngle);
    // The first contact is on both flanks, and the wheel's flank does pass through it.
    CHECK(contact.pinion_radius <= scene.pinion.tip_radius * (1 + 1e-12));
    CHECK(contact.wheel_radius <= scene.wheel.tip_radius * (1 + 1e-12));
    CHECK(std::abs(contact.pinion_z) <= scene.pinion.face.half());
    CHECK(std::abs(contact.wheel_z) <= scene.wheel.face.half() * (1 + 1e-12));
    // discretisation: the grid comes within half a step of it, on a slope of at most 1 in 20 (edges and corners)
    const double step = std::max(scene.pinion.highest_roll() - scene.pinion.lowest_roll(), 2 * scene.pinion.face.half()) / kGrid;
    CHECK(highest >= contact.phi2 - 0.5 * step / 20.0 / scene.wheel.base_radius);
  }
}

TEST_CASE("Contact that follows the start of the wheel's relief is still the first", "[core][contact][independent]") {
  // The section maxima lie on the relief's kink on the wheel, which crosses the pinion's flank obliquely.
  struct Case {
    double pinion_crown, wheel_crown;  // mm
    ProfileRelief tip, root;           // of the wheel
    double twist, crossing, phi1;      // mm, arcmin, rad
  };
  const auto linear = [](double amount, double height) { return ProfileRelief{amount, height, ReliefShape::Linear}; };
  const Case c = GENERATE_COPY(Case{0.002, 0.007, linear(0.015, 0.9), linear(0.013, 0.6), 0.011, 2.5, 0.08},
                               Case{0.009, 0.001, linear(0.023, 1.1), linear(0.039, 1.0), -0.018, 1.6, 0.12},
                               Case{0.019, 0.005, linear(0.037, 0.5), linear(0.028, 0.9), 0.002, -2.5, -0.11});
  const GearPair pair = make_gear_pair(pair_data(37, 49, 8 * deg, 0.2, 0.0, 42.0, 44.0));
  Modification pinion, wheel;
  pinion.lead_crowning = c.pinion_crown;
  wheel.lead_crowning = c.wheel_crown;
  wheel.tip_relief = c.tip;
  wheel.root_relief = c.root;
  wheel.twist = c.twist;
  Misalignment misalignment;
  misalignment.crossing = c.crossing * arcmin;
  const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
  CHECK(highest_on_grid(scene, c.phi1, 90) <= find_tooth_contact(scene, 0, c.phi1).phi2 + kRoundOffAngle);
}

TEST_CASE("The cusp at the base circle does not pass for contact", "[core][contact][independent]") {
  // 17 teeth without undercut to speak of: the involute starts on the base circle. A lead error moves that by some um.
  const double shift = GENERATE(-0.08, -0.05, 0.01, 0.02), beta = GENERATE(5.0, 12.0) * deg;
  const GearPair pair = make_gear_pair(pair_data(17, 65, beta, shift, 0.1));
  REQUIRE(pair.pinion.form_radius < 1.001 * pair.pinion.base_radius);
  Modification pinion;
  pinion.lead_crowning = 0.005;
  pinion.dedendum_crowning = 0.010;
  pinion.root_relief = {0.020, 0.6, ReliefShape::Linear};
  Misalignment misalignment;
  misalignment.pinion_lead_angle = -3 * arcmin;
  const FlankAssembly scene = scene_of(pair, misalignment, pinion);
  for (const double phi1 : {-0.17, -0.02, 0.01, 0.05, 0.15}) {
    const ToothContact contact = find_tooth_contact(scene, 0, phi1);
    if (!contact.exists()) continue;
    CAPTURE(shift, beta / deg, phi1, to_string(contact.kind), contact.pinion_radius);
    CHECK(highest_on_grid(scene, phi1, 60) <= contact.phi2 + kRoundOffAngle);
  }
}

TEST_CASE("The higher of two maxima of a hollow flank touches, wherever they lie", "[core][contact][closed-form]") {
  // Metal rises by H towards both ends and end relief takes it away again: maxima at the reliefs' starts z0. A lead
  // slope S decides which of them leads, by S z0/b.
  const GearPair pair = make_gear_pair(pair_data(24, 48, 0.0));
  const double hollow = 0.012, length = 6.0, z0 = 15.0 - length, slope = GENERATE(0.0004, -0.0004, 0.003, -0.003);
  Modification m;
  m.lead_crowning = -hollow;
  m.lead_slope = slope;
  m.end_relief = {0.050, length};
  const ToothContact contact = find_tooth_contact(scene_of(pair, {}, m), 0, 0.02);
  const double expected = hollow * std::pow(z0 / 15.0, 2) + std::abs(slope) * z0 / 30.0;
  CHECK(std::abs(contact.transmission_error - expected / pair.wheel.base_radius) <= kRoundOffAngle);
  CHECK(std::abs(contact.pinion_z + std::copysign(z0, slope)) <= 1e-9);
}

TEST_CASE("The higher of two maxima between the searched sections touches", "[core][contact][independent]") {
  struct Case {
    double beta, hollow, slope;  // deg, mm, mm
    EndRelief pinion, wheel;
  };
  const Case c = GENERATE(Case{20.0, 0.022, 0.002, {0.013, 7.5}, {0.019, 4.3}}, Case{20.0, 0.025, -0.001, {0.046, 5.5}, {0.016, 8.8}},
                          Case{0.0, 0.018, -0.005, {0.011, 5.9}, {0.046, 2.2}});
  const GearPair pair = make_gear_pair(pair_data(24, 48, c.beta * deg));
  Modification pinion, wheel;
  pinion.lead_crowning = -c.hollow;
  pinion.lead_slope = c.slope;
  pinion.end_relief = c.pinion;
  wheel.end_relief = c.wheel;
  const FlankAssembly scene = scene_of(pair, {}, pinion, wheel);
  CHECK(highest_on_grid(scene, 0.02, 90) <= find_tooth_contact(scene, 0, 0.02).phi2 + kRoundOffAngle);
}
