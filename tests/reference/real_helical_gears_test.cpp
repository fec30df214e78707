#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/flank/measured_grid.hpp"
#include "tests/core/contact/contact_cases.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "tests/reference/leading.hpp"
#include "core/gear/gear_pair.hpp"

// The 17:44 helical pair of "TCA of Real Helical Gears": m_n = 6 mm, alpha_n = 20 deg, beta = 24.43 deg, b = 92 mm, a
// pinion with deviations on 9 x 15 points and a theoretical wheel. The article describes three deviations and what its
// analysis shows of them in words; it gives no formula, no amplitude (up to 50 um elsewhere in the text) and no figure.

using namespace flankwright;
using namespace flankwright::contact_cases;
using reference::leading_contacts;
using reference::sequence_of_kinds;
using units::arcmin;
using units::arcsec;
using units::pi;
using units::um;

namespace {

constexpr double kFace = 92.0, kHalf = 46.0;
constexpr double kFitRipple = 0.3 * um;  // discretisation: the spline overshoots where a parabola sets in between two of 15 points

GearPair real_pair() { return pair_cases::pair(17, 44, 24.43, 6.0, kFace); }

/// Zero up to `start`, from there a parabola that reaches 1 at twice that.
double beyond(double distance, double start) { return distance > start ? std::pow(distance / start - 1, 2) : 0.0; }

/// The pinion with a deviation [mm, + = metal added] measured on 9 x 15 points that stop short of the flank's borders.
Modification measured(const GearPair& pair, const std::function<double(double r, double z)>& deviation) {
  MeasuredGrid grid;
  const double root = pair.pinion.active_root_radius, tip = pair.pinion.tip_radius, margin = 0.4;
  for (int i = 0; i < 9; ++i) grid.radii.push_back(root + margin + (tip - root - 2 * margin) * i / 8);
  for (int j = 0; j < 15; ++j) grid.z.push_back(-42.0 + 6.0 * j);
  grid.deviation.resize(9, 15);
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 15; ++j) grid.deviation(i, j) = deviation(grid.radii[i], grid.z[j]);
  }
  Modification m;
  m.topography = make_grid_field(grid, pair.pinion.base_radius, pair.base_helix_angle).field;
  return m;
}

constexpr double kStep = 0.02 * 2 * pi / 17;  // rad

/// Pair 0 from the first to the last point of the theoretical path of contact.
std::vector<ToothContact> passage(const GearPair& pair, const FlankAssembly& scene) {
  const double over_face = kHalf * std::tan(pair.base_helix_angle);
  const double first = (pair.path_start - pair.pitch_point - over_face) / pair.pinion.base_radius;
  const double last = (pair.path_end - pair.pitch_point + over_face) / pair.pinion.base_radius;
  std::vector<ToothContact> contacts;
  for (double phi1 = first; phi1 < last; phi1 += kStep) contacts.push_back(find_tooth_contact(scene, 0, phi1));
  return contacts;
}

double lag(const GearPair& pair, const ToothContact& c) { return -c.transmission_error * pair.wheel.base_radius; }

}  // namespace

TEST_CASE(
    "Real helical gears, longitudinal modification: flanks without error in the unmodified middle, tip edges in the "
    "modified zones",
    "[reference][contact]") {
  const GearPair pair = real_pair();
  const FlankAssembly scene = scene_of(pair, {}, measured(pair, [](double, double z) { return -50 * um * beyond(std::abs(z), kFace / 4); }));
  const std::vector<ToothContact> contacts = passage(pair, scene);
  // In on the wheel's tip at the end of the face that meets first, out over the pinion's tip at the other.
  CHECK(sequence_of_kinds(contacts) == std::vector<ContactKind>{ContactKind::WheelTip, ContactKind::Surface, ContactKind::PinionTip});
  double last_in = INFINITY, last_out = 0.0;
  int inside = 0;
  for (const ToothContact& c : contacts) {
    CAPTURE(c.phi1, to_string(c.kind), c.pinion_z);
    if (c.kind == ContactKind::Surface) {
      ++inside;
      CHECK(std::abs(c.pinion_z) < kFace / 4);
      CHECK(std::abs(lag(pair, c)) <= kFitRipple);
    } else if (c.kind == ContactKind::WheelTip && c.pinion_z > 24.0) {
      CHECK(lag(pair, c) < last_in);  // catches up
      last_in = lag(pair, c);
    } else if (c.kind == ContactKind::PinionTip && c.pinion_z < -24.0) {
      CHECK(lag(pair, c) > last_out);  // falls behind
      last_out = lag(pair, c);
    }
  }
  CHECK(inside >= 110);
  CHECK(last_out >= 30 * um);
  CHECK(analyse_unloaded_mesh(pair, scene, 64).peak_to_peak <= 0.1 * arcsec);  // some pair is always in the middle
}

TEST_CASE("Real helical gears, three-dimensional modification: the leading pair stays inside the flanks, misaligned or not", "[reference][contact]") {
  const GearPair pair = real_pair();
  const double middle = 0.5 * (pair.pinion.active_root_radius + pair.pinion.tip_radius);
  const double quarter = 0.25 * (pair.pinion.tip_radius - pair.pinion.active_root_radius);
  const Modification modified =
      measured(pair, [&](double r, double z) { return -25 * um * (beyond(std::abs(z), kFace / 4) + beyond(std::abs(r - middle), quarter)); });
  const UnloadedMesh aligned = analyse_unloaded_mesh(pair, scene_of(pair, {}, modified), 64);
  CHECK(aligned.peak_to_peak * pair.wheel.base_radius <= kFitRipple);
  for (const ToothContact& c : leading_contacts(aligned)) {
    CHECK(c.kind == ContactKind::Surface);
    CHECK(std::abs(c.pinion_z) <= kFace / 4);
    CHECK(std::abs(c.pinion_radius - middle) <= quarter);
    CHECK(std::abs(lag(pair, c)) <= kFitRipple);
  }
  // No edge while the pair is anywhere near the mesh; the modified zones only cost transmission error.
  for (const ToothContact& c : passage(pair, scene_of(pair, {}, modified))) {
    if (std::abs(c.phi1) <= 1.5 * 2 * pi / 17) CHECK(c.kind == ContactKind::Surface);
  }

  // Misaligned: the path shifts to the closing end, the transmission error keeps its shape: one rise, one fall, one
  // transfer point a pitch.
  double peak[2];
  for (const double sign : {1.0, -1.0}) {
    Misalignment misalignment;
    misalignment.crossing = sign * 3 * arcmin;
    const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair, misalignment, modified), 64);
    double mean_z = 0.0;
    for (const ToothContact& c : leading_contacts(mesh)) {
      CHECK(c.kind == ContactKind::Surface);
      mean_z += c.pinion_z / 64;
    }
    CHECK(sign * mean_z > 20.0);
    CHECK(sign * mean_z < 40.0);
    REQUIRE(mesh.transfers.size() == 1);
    CHECK(mesh.transfers[0].slope_before < 0.0);
    CHECK(mesh.transfers[0].slope_after > 0.0);
    peak[sign > 0.0] = mesh.peak_to_peak / arcsec;
  }
  CHECK(std::abs(peak[0] / peak[1] - 1) <= 0.3);
}

TEST_CASE(
    "Real helical gears, helix deviation off the middle: edge, flank, edge, for unequal times, with an asymmetric "
    "error",
    "[reference][contact]") {
  // A parabola about a place a quarter of the face off the middle: towards the end that meets first, or that leaves
  // last.
  const double top = GENERATE(1.0, -1.0) * kFace / 4;
  const GearPair pair = real_pair();
  REQUIRE(pair.contact_line_sense() == 1);  // pairs come in at z = +b/2
  const FlankAssembly scene =
      scene_of(pair, {}, measured(pair, [&](double, double z) { return -50 * um * std::pow((z - top) / (0.75 * kFace), 2); }));
  const std::vector<ToothContact> contacts = passage(pair, scene);
  CHECK(sequence_of_kinds(contacts) == std::vector<ContactKind>{ContactKind::WheelTip, ContactKind::Surface, ContactKind::PinionTip});
  int before = 0, on_flank = 0, after = 0;
  for (const ToothContact& c : contacts) {
    CAPTURE(top, c.phi1, c.pinion_z);
    if (c.kind == ContactKind::Surface) {
      ++on_flank;
      CHECK(std::abs(c.pinion_z - top) <= 0.5);
      CHECK(std::abs(lag(pair, c)) <= 0.1 * um);
    }
    before += c.kind == ContactKind::WheelTip;
    after += c.kind == ContactKind::PinionTip;
  }
  // The flank carries for the transverse contact ratio; the tip edges for the face on either side, b/2 -+ top.
  const double per_mm = std::tan(pair.base_helix_angle) / pair.transverse_base_pitch / 0.02;  // positions
  CHECK(std::abs(on_flank - pair.transverse_contact_ratio / 0.02) <= 3);
  CHECK(std::abs(before - (kHalf - top) * per_mm) <= 3);
  CHECK(std::abs(after - (kHalf + top) * per_mm) <= 3);
  // What it costs where the pair comes in and where it goes out: the larger on the side with more face.
  const double at_entry = lag(pair, contacts.front()), at_exit = lag(pair, contacts.back());
  CHECK((top > 0.0 ? at_exit / at_entry : at_entry / at_exit) >= 4.0);
}

TEST_CASE("Real helical gears, helix deviation from one face end: the pair rides on that end", "[reference][contact]") {
  const GearPair pair = real_pair();
  const FlankAssembly scene = scene_of(pair, {}, measured(pair, [](double, double z) { return -50 * um * std::pow((z + kHalf) / kFace, 2); }));
  std::vector<ToothContact> contacts = passage(pair, scene);
  const std::vector<ContactKind> sequence = sequence_of_kinds(contacts);
  REQUIRE(sequence.size() >= 2);
  CHECK(sequence[0] == ContactKind::WheelTip);
  CHECK(sequence[1] == ContactKind::FaceEnd);
  // From the end that meets first the tip edge runs down the whole face, catching up all the way.
  double last = INFINITY;
  for (const ToothContact& c : contacts) {
    CAPTURE(c.phi1, to_string(c.kind), c.pinion_z);
    if (c.kind == ContactKind::WheelTip) {
      CHECK(lag(pair, c) < last);
      last = lag(pair, c);
    } else if (c.kind == ContactKind::FaceEnd) {
      CHECK(c.pinion_z == -kHalf);
      CHECK(std::abs(lag(pair, c)) <= 0.1 * um);
    }
  }
  CHECK(lag(pair, contacts.front()) >= 40 * um);
  for (const ToothContact& c : leading_contacts(analyse_unloaded_mesh(pair, scene, 64))) CHECK(c.kind == ContactKind::FaceEnd);
}
