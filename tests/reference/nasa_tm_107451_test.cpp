#include "tests/reference/nasa_tm_107451.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/leading.hpp"
#include "core/gear/gear_pair.hpp"

// What NASA TM-107451 states of its example, figure by figure.
//
// Slopes of the transmission error where an edge touches. Two involutes in one transverse section turn each other in
// the ratio of their base radii at any centre distance, so contact that stays at a face end has d(phi2)/d(phi1) =
// r_b1/r_b2. A tip edge touches the mate's helicoid at one radius, and the point runs along both helices:
// d(phi2)/d(phi1) = p_1/p_2. Both are exact for parallel axes, whatever the pinion's errors; crossing of the axes by g
// acts as a lead-angle error of g, to first order.

using namespace flankwright;
using namespace flankwright::contact_cases;
using reference::leading_contacts;
using units::arcmin;
using units::arcsec;
using units::pi;
namespace nasa = reference::nasa_tm_107451;

namespace {

constexpr int kPositions = 64;

Misalignment errors(double crossing, double lead_angle, double pressure_angle) {
  Misalignment m;
  m.crossing = crossing * arcmin;
  m.pinion_lead_angle = lead_angle * arcmin;
  m.pinion_pressure_angle = pressure_angle * arcmin;
  return m;
}

struct Slopes {
  double face_end, tip;
};

/// Exact slopes for parallel axes, from the pinion as it was really made (appendix 2).
Slopes slopes_of(const FlankAssembly& scene) {
  return {scene.pinion.base_radius / scene.wheel.base_radius - scene.speed_ratio(),
          std::abs(scene.wheel.helix_rate / scene.pinion.helix_rate) - scene.speed_ratio()};
}

bool is_tip(const ToothContact& c) { return c.kind == ContactKind::PinionTip || c.kind == ContactKind::WheelTip; }

/// Checks every leading contact off the corners against the two slopes; counts them.
struct Branches {
  int face_end{0}, tip{0}, other{0};
  Branches(const UnloadedMesh& mesh, const Slopes& expected, double tolerance) {
    for (const ToothContact& c : leading_contacts(mesh)) {
      CAPTURE(c.phi1, to_string(c.kind), c.slope / arcsec, expected.face_end / arcsec, expected.tip / arcsec);
      if (c.kind == ContactKind::FaceEnd) {
        ++face_end;
        CHECK(std::abs(c.slope - expected.face_end) <= tolerance);
      } else if (is_tip(c)) {
        ++tip;
        CHECK(std::abs(c.slope - expected.tip) <= tolerance);
      } else {
        ++other;
      }
    }
  }
};

}  // namespace

TEST_CASE("TM-107451, eq. 14: aligned gears touch along a line and transmit without error", "[reference][contact]") {
  const GearPair pair = make_gear_pair(nasa::pair_data());
  CHECK(std::abs(pair.data.helix_angle - (90 * units::deg - nasa::lead_angle)) <= 1e-15);
  const FlankAssembly scene = scene_of(pair);
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, kPositions);
  for (const double te : mesh.transmission_error) CHECK(std::abs(te) <= 1e-9);
  for (const double phi1 : mesh.phi1) CHECK(find_tooth_contact(scene, 0, phi1).kind == ContactKind::Line);
}

TEST_CASE(
    "TM-107451, figs 2 and 3: a lead-angle error of 3 minutes puts the contact on edges and the error on two straight "
    "lines",
    "[reference][contact][closed-form]") {
  const double minutes = GENERATE(3.0, -3.0);
  const GearPair pair = make_gear_pair(nasa::pair_data());
  const FlankAssembly scene = scene_of(pair, errors(0.0, minutes, 0.0));
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, kPositions);
  const Slopes slopes = slopes_of(scene);
  CHECK(slopes.face_end * slopes.tip < 0.0);
  const Branches branches(mesh, slopes, 1e-9);  // round-off of a place on an edge, rad/rad
  CHECK(branches.face_end > 2 * branches.tip);
  CHECK(branches.tip >= 5);
  CHECK(branches.other <= 2);
  // Discontinuous: at the transfer point the speed jumps by the whole difference of the two.
  REQUIRE(mesh.transfers.size() == 1);
  CHECK(std::abs(mesh.transfers[0].slope_jump() - std::abs(slopes.tip - slopes.face_end)) <= 1e-9);
}

TEST_CASE("TM-107451, figs 2 and 3: crossing of the axes by 3 minutes does the same as the lead-angle error", "[reference][contact][closed-form]") {
  const double minutes = GENERATE(3.0, -3.0);
  const GearPair pair = make_gear_pair(nasa::pair_data());
  const Slopes equal = slopes_of(scene_of(pair, errors(0.0, minutes, 0.0)));
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair, errors(minutes, 0.0, 0.0)), kPositions);
  const Branches branches(mesh, equal, 3e-3 * std::abs(equal.tip));  // model: second order, 3 angles relative
  CHECK(branches.face_end >= 40);
  CHECK(branches.tip >= 8);
  CHECK(branches.other <= 2);
  CHECK(mesh.transfers.size() == 1);
  CHECK(mesh.transfers[0].slope_jump() > 0.0);
  const UnloadedMesh by_lead = analyse_unloaded_mesh(pair, scene_of(pair, errors(0.0, minutes, 0.0)), kPositions);
  CHECK(std::abs(mesh.peak_to_peak / by_lead.peak_to_peak - 1) <= 5e-3);  // model
}

TEST_CASE(
    "TM-107451, fig. 4: a pressure-angle error of 3 minutes moves the contact to the end of the profile, without "
    "transmission error",
    "[reference][contact][closed-form]") {
  const double minutes = GENERATE(3.0, -3.0);
  const GearPair pair = make_gear_pair(nasa::pair_data());
  const FlankAssembly scene = scene_of(pair, errors(0.0, 0.0, minutes));
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, kPositions);
  CHECK(std::abs(slopes_of(scene).tip) <= 1e-14);  // eqs 15-17 keep the lead
  CHECK(mesh.peak_to_peak <= 1e-12);               // round-off, rad
  // A larger pressure angle leaves metal on the pinion's dedendum, a smaller one on its addendum.
  const ContactKind expected = minutes > 0.0 ? ContactKind::WheelTip : ContactKind::PinionTip;
  for (const ToothContact& c : leading_contacts(mesh)) CHECK(c.kind == expected);
}

TEST_CASE(
    "TM-107451, figs 5 and 6: crossing by 3 minutes with a lead-angle error of -4 leaves a minute's two lines on the "
    "edges",
    "[reference][contact][closed-form]") {
  const GearPair pair = make_gear_pair(nasa::pair_data());
  const Slopes minute = slopes_of(scene_of(pair, errors(0.0, -1.0, 0.0)));
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair, errors(3.0, -4.0, 0.0)), kPositions);
  const Branches branches(mesh, minute,
                          6e-3 * std::abs(minute.tip));  // model: second order of 3 and 4 minutes against one minute
  CHECK(branches.face_end >= 40);
  CHECK(branches.tip >= 8);
  CHECK(branches.other <= 2);
  CHECK(minute.face_end > 0.0);
  CHECK(minute.tip < 0.0);
}

TEST_CASE(
    "TM-107451, figs 7 and 8: a pressure-angle error of 3 minutes with a lead-angle error of -2 runs on a face end, "
    "its error almost linear",
    "[reference][contact][closed-form]") {
  const GearPair pair = make_gear_pair(nasa::pair_data());
  const FlankAssembly scene = scene_of(pair, errors(0.0, -2.0, 3.0));
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, kPositions);
  const Branches branches(mesh, slopes_of(scene), 1e-9);  // round-off of a place on an edge
  CHECK(branches.tip == 0);
  CHECK(branches.face_end >= kPositions - 8);  // the next pair comes in at its corner
  int at_end = 0;
  for (const ToothContact& c : leading_contacts(mesh)) at_end += std::abs(c.pinion_z + 0.5 * pair.face_width) <= 1e-6;
  CHECK(at_end == kPositions);
}

TEST_CASE("TM-107451, fig. 9: crossing by 3 minutes with a lead-angle error of -3 transmits without error", "[reference][contact]") {
  const GearPair pair = make_gear_pair(nasa::pair_data());
  Misalignment both = errors(3.0, -3.0, 0.0);
  CHECK(analyse_unloaded_mesh(pair, scene_of(pair, both), kPositions).peak_to_peak <= 1e-3 * arcsec);  // model: second order
  SECTION("at the nominal centre distance on edges") {
    for (const ToothContact& c : leading_contacts(analyse_unloaded_mesh(pair, scene_of(pair, both), kPositions))) {
      CHECK((c.kind == ContactKind::FaceEnd || c.kind == ContactKind::Corner || is_tip(c)));
    }
  }
  SECTION("inside the flanks where the centre distance follows the changed pitch radius") {
    // Crossed helical gears: each on its own pitch cylinder, appendix 2 with lambda_p1 changed.
    const double radius = pair.data.normal_module * pair.data.pinion.teeth / 2;
    both.centre_distance = radius / std::sin(nasa::lead_angle - nasa::error) - radius / std::sin(nasa::lead_angle);
    REQUIRE(both.centre_distance > 0.04);
    const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair, both), kPositions);
    CHECK(mesh.peak_to_peak <= 1e-10);  // rad
    for (const ToothContact& c : leading_contacts(mesh)) {
      CHECK((c.kind == ContactKind::Surface || c.kind == ContactKind::Line));
      CHECK(std::abs(c.pinion_z) < 0.5 * pair.face_width);
    }
  }
}

TEST_CASE(
    "TM-107451, figs 12 and 13: a pinion cut by a parabolic rack keeps a crossed path near the middle of its profile, "
    "along the tooth, "
    "and its error almost linear",
    "[reference][contact][closed-form]") {
  // The paper gives no parabola coefficient; the path leaves the middle the less, the larger it is.
  const double coefficient = GENERATE(0.001, 0.002);  // 1/mm
  PairData data = nasa::pair_data();
  data.pinion.generation = ParabolicRack{coefficient};
  const GearPair pair = make_gear_pair(data);
  const double pitch_radius = pair.pinion.reference_radius, height = pair.pinion.tip_radius - pair.pinion.form_radius;

  const FlankAssembly aligned = scene_of(pair);
  const FlankAssembly crossed = scene_of(pair, errors(3.0, 0.0, 0.0));
  // Contact stays at one radius, as on a tip edge: the slope is that of the leads.
  const double slope = slopes_of(scene_of(pair, errors(0.0, 3.0, 0.0))).tip;
  double radius = 0.0, lowest_z = 0.0, highest_z = 0.0;
  int on_surface = 0;
  for (double phi1 = -0.19; phi1 < 0.1; phi1 += 0.01) {
    const ToothContact straight = find_tooth_contact(aligned, 0, phi1);
    if (straight.kind == ContactKind::Surface) {
      CHECK(std::abs(straight.transmission_error) <= 1e-12);
      CHECK(std::abs(straight.pinion_radius - pitch_radius) <= 1e-5);  // mm: a flat top, placed by its slope
    }
    const ToothContact contact = find_tooth_contact(crossed, 0, phi1);
    if (contact.kind != ContactKind::Surface) continue;
    CAPTURE(coefficient, phi1, contact.pinion_radius, contact.pinion_z);
    if (on_surface++ == 0) radius = contact.pinion_radius;
    CHECK(std::abs(contact.pinion_radius - radius) <= 1e-3);                 // along the tooth
    CHECK(std::abs(contact.pinion_radius - pitch_radius) <= 0.21 * height);  // near the middle
    CHECK(std::abs(contact.slope / slope - 1) <= 3e-3);                      // model: second order of the crossing
    lowest_z = std::min(lowest_z, contact.pinion_z);
    highest_z = std::max(highest_z, contact.pinion_z);
  }
  CHECK(on_surface >= 20);
  CHECK(highest_z - lowest_z >= 0.8 * pair.face_width);
  // A localised contact is not enough (conclusion of section 3): the speed still jumps at the transfer point.
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, crossed, kPositions);
  REQUIRE(mesh.transfers.size() == 1);
  CHECK(mesh.transfers[0].slope_jump() >= 0.8 * slope);
  CHECK(mesh.peak_to_peak >= 5 * arcsec);
}
