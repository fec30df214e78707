#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/haddad_18_54.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::deg;
using units::pi;

namespace {

std::vector<PairData> aligned_pairs() {
  return {reference::nasa_tm_107451::pair_data(),
          reference::haddad_18_54::pair_data(),
          pair_data(20, 40, 0.0),
          pair_data(25, 25, 0.0, 0.3, -0.3),
          pair_data(18, 60, 0.0, 0.4, 0.2, 40.0, 30.0),
          pair_data(19, 60, 15 * deg, 0.5, 0.1, 20.0, 30.0),
          pair_data(40, 23, 28 * deg, 0.0, 0.2, 30.0, 22.0)};
}

}  // namespace

TEST_CASE("Aligned involute gears touch along a line and transmit exactly their ratio", "[core][contact][closed-form]") {
  constexpr double kRoundOff = 1e-12;  // rad
  const Hand hand = GENERATE(Hand::Right, Hand::Left);
  const WorkingFlank flank = GENERATE(WorkingFlank::Right, WorkingFlank::Left);
  for (PairData data : aligned_pairs()) {
    data.pinion_hand = hand;
    data.working_flank = flank;
    const GearPair pair = make_gear_pair(data);
    const FlankAssembly scene = scene_of(pair);
    const PathOfContact path(pair);
    const double extent = pair.overlap_ratio + pair.transverse_contact_ratio;
    CAPTURE(data.pinion.teeth, data.wheel.teeth, data.helix_angle);
    int in_contact = 0;
    for (int i = 0; i < 24; ++i) {
      const double phi1 = 2 * pi / data.pinion.teeth * (extent * (i + 0.37) / 24.0 - 0.5 * extent);
      // The pair touches from when the leading end of its line enters at A until the trailing end leaves at E.
      const double leading = path.line_phase_at(phi1, pair), trailing = leading - pair.overlap_ratio;
      const bool well_inside = leading > PathOfContact::extension + 0.02 && trailing < path.region_length - PathOfContact::extension - 0.02;
      const ToothContact contact = find_tooth_contact(scene, 0, phi1);
      if (!well_inside) continue;
      ++in_contact;
      CHECK(contact.kind == ContactKind::Line);
      CHECK(std::abs(contact.transmission_error) <= kRoundOff);
      // The point lies on the contact line: plane of action, moving along it with the base circle.
      const double roll =
          pair.pitch_point + pair.pinion.base_radius * phi1 + pair.contact_line_sense() * std::tan(pair.base_helix_angle) * contact.pinion_z;
      CHECK(std::abs(std::hypot(pair.pinion.base_radius, roll) - contact.pinion_radius) <= 1e-4);
      CHECK(std::abs(std::hypot(pair.wheel.base_radius, pair.path_length - roll) - contact.wheel_radius) <= 1e-4);
      CHECK(std::abs(contact.pinion_z) <= 0.5 * pair.face_width * (1 + 1e-12));
      CHECK(std::abs(contact.wheel_z - contact.pinion_z) <= 1e-12);
    }
    CHECK(in_contact >= 16);
  }
}

TEST_CASE("The mesh of aligned gears has no transmission error and no transfer point", "[core][contact][closed-form]") {
  for (const PairData& data : aligned_pairs()) {
    const GearPair pair = make_gear_pair(data);
    const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair), 16);
    CAPTURE(data.pinion.teeth, data.wheel.teeth, data.helix_angle);
    CHECK(mesh.missing == 0);
    CHECK(mesh.transmission_error.size() == 16);
    for (const double te : mesh.transmission_error) CHECK(std::abs(te) <= 1e-12);  // round-off
    CHECK(mesh.peak_to_peak <= 1e-12);
    REQUIRE(mesh.harmonics.size() == 7);  // orders that 16 samples resolve
    for (const double amplitude : mesh.harmonics) CHECK(amplitude <= 1e-12);
  }
}

TEST_CASE("Any tooth pair is the reference pair, pitches later", "[core][contact]") {
  Random random(7);
  const GearPair pair = make_gear_pair(pair_data(21, 37, 18 * deg));
  const Misalignment misalignment = random_misalignment(random);
  const FlankAssembly scene = scene_of(pair, misalignment, random_modification(random, pair.pinion));
  for (int tooth = -2; tooth <= 2; ++tooth) {
    const double phi1 = 0.03;
    const ToothContact shifted = find_tooth_contact(scene, tooth, phi1 - tooth * 2 * pi / 21);
    const ToothContact reference = find_tooth_contact(scene, 0, phi1);
    CHECK(std::abs(shifted.transmission_error - reference.transmission_error) <= 1e-12);  // round-off
    CHECK(shifted.kind == reference.kind);
  }
}

TEST_CASE("A centre distance that changes with the wheel still backs onto the flank without transmission error", "[core][contact][closed-form]") {
  // Involutes keep their ratio at any centre distance; the flanks separate by inv(alpha') - inv(alpha) at both gears:
  // the wheel must turn on by (z1 + z2)/z2 times that to touch.
  const GearPair pair = make_gear_pair(pair_data(24, 41, 12 * deg, 0.2, 0.0));
  Misalignment misalignment;
  misalignment.centre_distance = GENERATE(-0.1, 0.05, 0.4);
  const double alpha = std::acos((pair.pinion.base_radius + pair.wheel.base_radius) / (pair.centre_distance + misalignment.centre_distance));
  const auto inv = [](double angle) { return std::tan(angle) - angle; };
  const double expected = -(24.0 + 41.0) / 41.0 * (inv(alpha) - inv(pair.working_transverse_pressure_angle));
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair, misalignment), 12);
  for (const double te : mesh.transmission_error) CHECK(std::abs(te - expected) <= 1e-12);  // round-off
}

TEST_CASE("An axial offset turns an aligned helical wheel by its helix", "[core][contact][closed-form]") {
  const int sense = GENERATE(1, -1);
  PairData data = pair_data(24, 41, 20 * deg);
  data.pinion_hand = sense > 0 ? Hand::Right : Hand::Left;
  const GearPair pair = make_gear_pair(data);
  Misalignment misalignment;
  misalignment.axial_offset = 1.5;
  // Moving the wheel's flank by dz moves it by -s dz tan(beta_b) along the base tangent towards +y.
  const double expected = sense * 1.5 * std::tan(pair.base_helix_angle) / pair.wheel.base_radius;
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair, misalignment), 8);
  for (const double te : mesh.transmission_error) CHECK(std::abs(te - expected) <= 1e-12);  // round-off
}

TEST_CASE("The mirror image of a gear pair has the same transmission error", "[core][contact]") {
  constexpr double kRoundOff = 1e-12;  // rad
  Random random(20250717);
  for (int i = 0; i < 8; ++i) {
    PairData data = random_pair_data(random);
    data.helix_angle = 18 * deg;
    const GearPair pair = make_gear_pair(data);
    const Modification pinion = random_modification(random, pair.pinion), wheel = random_modification(random, pair.wheel);
    const Misalignment misalignment = random_misalignment(random);
    const auto error_at = [&](const PairData& d, const Misalignment& m, const Modification& m1, const Modification& m2) {
      std::vector<double> te;
      const FlankAssembly scene = assemble_flanks(make_gear_pair(d), {.modification = {m1, m2}, .misalignment = m});
      for (const double phi1 : {-0.1, 0.0, 0.06}) te.push_back(find_tooth_contact(scene, 0, phi1).transmission_error);
      return te;
    };
    const std::vector<double> as_given = error_at(data, misalignment, pinion, wheel);

    // In the plane of mid face: hands and everything odd in z change sign.
    PairData other_hand = data;
    other_hand.pinion_hand = data.pinion_hand == Hand::Right ? Hand::Left : Hand::Right;
    Misalignment seen = misalignment;
    seen.crossing *= -1;
    seen.intersecting *= -1;
    seen.axial_offset *= -1;
    seen.mesh_misalignment *= -1;
    Modification pinion_seen = pinion, wheel_seen = wheel;
    for (Modification* m : {&pinion_seen, &wheel_seen}) {
      m->lead_slope *= -1;
      m->twist *= -1;
    }
    const std::vector<double> mid_face = error_at(other_hand, seen, pinion_seen, wheel_seen);

    // In the plane of the axes: hands, flanks and the crossing change sign; z stays.
    PairData other_flank = other_hand;
    other_flank.working_flank = data.working_flank == WorkingFlank::Right ? WorkingFlank::Left : WorkingFlank::Right;
    seen = misalignment;
    seen.crossing *= -1;
    const std::vector<double> plane_of_axes = error_at(other_flank, seen, pinion, wheel);

    for (std::size_t k = 0; k < as_given.size(); ++k) {
      CAPTURE(i, k);
      CHECK(std::abs(mid_face[k] - as_given[k]) <= kRoundOff);
      CHECK(std::abs(plane_of_axes[k] - as_given[k]) <= kRoundOff);
    }
  }
}
