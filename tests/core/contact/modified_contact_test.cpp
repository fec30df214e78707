#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::deg;
using units::pi;

namespace {

constexpr double kAngleRoundOff = 1e-12;  // rad

}  // namespace

TEST_CASE("A lead crown touches at its top, without transmission error, while its top is in mesh", "[core][contact][closed-form]") {
  const double crown = GENERATE(0.005, 0.020);
  const Member crowned = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  Modification m;
  m.lead_crowning = crown;
  const FlankAssembly scene = crowned == Member::Pinion ? scene_of(pair, {}, m, {}) : scene_of(pair, {}, {}, m);
  const double tan_b = std::tan(pair.base_helix_angle), face = pair.face_width;
  int at_top = 0, at_tip = 0;
  for (double phi1 = -0.27; phi1 < 0.27; phi1 += 0.01) {
    const ToothContact contact = find_tooth_contact(scene, 0, phi1);
    CHECK(contact.transmission_error <= kAngleRoundOff);
    const double roll = pair.pitch_point + pair.pinion.base_radius * phi1;  // at mid face
    CAPTURE(crown, phi1, to_string(contact.kind));
    if (roll > pair.path_start + 0.1 && roll < pair.path_end - 0.1) {
      ++at_top;
      CHECK(contact.kind == ContactKind::Surface);
      CHECK(std::abs(contact.transmission_error) <= kAngleRoundOff);
      CHECK(std::abs(contact.pinion_z) <= 1e-3);  // mm: a flat top, placed by its slope
    } else if (contact.kind == ContactKind::PinionTip || contact.kind == ContactKind::WheelTip) {
      ++at_tip;
      // The line ends on a tip edge at z; beyond the plane of action the edge gains (slope)^2/(2 k), see
      // misaligned_contact_test.
      const bool pinion_tip = contact.kind == ContactKind::PinionTip;
      const double rho1 = pinion_tip ? pair.path_end : pair.path_start, rho2 = pair.path_length - rho1;
      const double z = (rho1 - roll) / tan_b;
      const double ratio = pinion_tip ? rho1 / pair.pinion.base_radius : rho2 / pair.wheel.base_radius;
      const double k = (1 / rho1 + 1 / rho2) * ratio * ratio;
      const double slope = 8 * crown * z / (face * face * tan_b);
      const double on_plane = -crown * std::pow(2 * z / face, 2) / pair.wheel.base_radius;
      const double gain = slope * slope / (2 * k) / pair.wheel.base_radius;
      // model: the gain's own next order, and D/r relative for the tip radius that the removal takes along
      CHECK(std::abs(contact.transmission_error - on_plane - gain) <= 0.25 * gain + 0.01 * std::abs(on_plane));
    }
  }
  CHECK(at_top >= 25);
  CHECK(at_tip >= 10);
  // With a transverse contact ratio above 1 some pair always touches at its crown.
  CHECK(pair.transverse_contact_ratio > 1.0);
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, 12);
  for (const double te : mesh.transmission_error) CHECK(std::abs(te) <= kAngleRoundOff);
}

TEST_CASE("A spur pair with tip relief falls behind by the relief at its point of contact", "[core][contact][closed-form]") {
  const ReliefShape shape = GENERATE(ReliefShape::Linear, ReliefShape::Parabolic);
  const GearPair pair = make_gear_pair(pair_data(25, 50, 0.0));
  Modification m;
  m.tip_relief = {0.020, 1.5, shape};
  const FlankAssembly scene = scene_of(pair, {}, m);
  const double start = pair.pinion.tip_radius - 1.5;
  int relieved = 0, plain = 0;
  const double rb1 = pair.pinion.base_radius, rb2 = pair.wheel.base_radius;
  for (double rho = pair.path_start + 0.2; rho < pair.path_end - 0.1; rho += 0.17) {
    const double phi1 = (rho - pair.pitch_point) / rb1;
    const ToothContact contact = find_tooth_contact(scene, 0, phi1);
    const double radius = std::hypot(rb1, rho);
    const double te = -removal(m, scene.pinion.frame, radius, 0.0) / rb2;
    const double slope = (removal(m, scene.pinion.frame, radius + 1e-3, 0.0) - removal(m, scene.pinion.frame, radius - 1e-3, 0.0)) / 2e-3 * rho /
                         radius;  // along the line of action: dr = rho/r d(rho)
    const double rho2 = pair.path_length - rho;
    const double k = (1 / rho + 1 / rho2) * (rho / rb1) * (rho / rb1);
    const double gain = slope * slope / (2 * k) / rb2;  // contact slides to where less is removed
    CAPTURE(rho, contact.pinion_radius);
    CHECK(contact.kind == ContactKind::Line);
    if (radius < start - 0.05) {
      ++plain;
      CHECK(std::abs(contact.transmission_error) <= kAngleRoundOff);
    } else if (radius > start + 0.6) {
      ++relieved;
      CHECK(std::abs(contact.transmission_error - te - gain) <= 0.25 * gain);  // model: third order in the slope
    } else {
      CHECK(contact.transmission_error <= kAngleRoundOff);
      CHECK(contact.transmission_error >= te - kAngleRoundOff);
    }
  }
  CHECK(relieved >= 5);
  CHECK(plain >= 20);
}

TEST_CASE("A lead slope on both gears that cancels leaves line contact", "[core][contact][closed-form]") {
  const GearPair pair = make_gear_pair(pair_data(21, 44, 0.0));
  Modification up, down;
  up.lead_slope = 0.012;
  down.lead_slope = -0.012;
  const ToothContact contact = find_tooth_contact(scene_of(pair, {}, up, down), 0, 0.02);
  CHECK(contact.kind == ContactKind::Line);
  CHECK(std::abs(contact.transmission_error) <= kAngleRoundOff);
}

TEST_CASE("Pitch errors move a pair's transmission error by the metal on its own teeth", "[core][contact][closed-form]") {
  const GearPair pair = make_gear_pair(pair_data(21, 44, 14 * deg));
  ManufacturingError pinion, wheel;
  pinion.pitch_step = 0.003;
  wheel.cumulative_pitch = {0.0, -0.001, 0.002};
  const FlankAssembly scene = assemble_flanks(pair, {.error = {pinion, wheel}});
  for (int tooth = -1; tooth <= 1; ++tooth) {
    const ToothContact contact = find_tooth_contact(scene, tooth, -tooth * 2 * pi / 21);
    const double metal = pitch_deviation(pinion, tooth) + pitch_deviation(wheel, tooth);
    CHECK(std::abs(contact.transmission_error - metal / pair.wheel.base_radius) <= kAngleRoundOff);
  }
}

TEST_CASE("Removing material never advances the wheel", "[core][contact]") {
  Random random(41);
  for (int i = 0; i < 12; ++i) {
    const PairData data = random_pair_data(random);
    if (!find_problems(data).empty()) continue;
    const GearPair pair = make_gear_pair(data);
    const Misalignment misalignment = random_misalignment(random);
    const Modification pinion = random_modification(random, pair.pinion), wheel = random_modification(random, pair.wheel);
    const auto more = [&](Modification m) {
      m.lead_crowning += 0.004;
      m.addendum_crowning += 0.003;
      m.tip_relief.amount += m.tip_relief.height > 0.0 ? 0.005 : 0.0;
      m.end_relief.amount += m.end_relief.length > 0.0 ? 0.005 : 0.0;
      return m;
    };
    for (const double phi1 : {-0.12, -0.03, 0.06, 0.15}) {
      const ToothContact as_is = find_tooth_contact(scene_of(pair, misalignment, pinion, wheel), 0, phi1);
      if (!as_is.exists()) continue;
      CAPTURE(i, phi1, to_string(as_is.kind));
      CHECK(find_tooth_contact(scene_of(pair, misalignment, more(pinion), wheel), 0, phi1).phi2 <= as_is.phi2 + kAngleRoundOff);
      CHECK(find_tooth_contact(scene_of(pair, misalignment, pinion, more(wheel)), 0, phi1).phi2 <= as_is.phi2 + kAngleRoundOff);
    }
  }
}
