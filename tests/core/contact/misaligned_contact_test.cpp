#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

// Closed form of the transmission error of a helical pair whose wheel is turned by a small angle g about the line of
// centres.
//
// Contact lines of the aligned pair lie in the plane of action; with s the distance from the pitch point along the line
// of action, the line of pair 0 is s = r_b1 phi1 + S z tan(beta_b), S = contact_line_sense(). The pinion's outward
// normal on all of it is n = (cos(b) sin(a), cos(b) cos(a), -S sin(b)), a = alpha_wt, b = beta_b. The rotation
// displaces the wheel's point at (x, y = s cos(a), z) by g (0, -z, y), which closes the gap along n by
//
//     g cos(a) (z cos(b) + S s sin(b)) = g cos(a) (z / cos(b) + S sin(b) r_b1 phi1)
//
// and the wheel is ahead by the largest closing on the line, over r_b2 cos(b). Hence two branches with contact on
// edges:
//     face end, z = +-b/2 fixed:            d(TE)/d(phi1) = + S g cos(a) tan(b) N1/N2
//     tip edge, s fixed, z moves with phi1: d(TE)/d(phi1) = - S g cos(a) cot(b) N1/N2
// The branches meet once a pitch P, so that the envelope of all pairs has the peak-to-peak P m1 m2/(m1 + m2), m1 and m2
// the magnitudes of the slopes. A tip edge touches a little off the plane of action: a distance d beyond the path's end
// the clearance is k d^2 cos(b)/2 with k = (1/rho_1 + 1/rho_2)(rho/r_b)^2, rho and r_b of the gear with the tip, so the
// edge gains (g cos(a)/sin(b))^2 / (2 k cos(b)) on the plane-of-action value, of second order in g.

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::arcsec;
using units::pi;

namespace {

GearPair nasa_pair(Hand hand) {
  PairData data = reference::nasa_tm_107451::pair_data();
  data.pinion_hand = hand;
  return make_gear_pair(data);
}

struct Slopes {
  double face_end, tip;
};

Slopes closed_form_slopes(const GearPair& pair, double crossing) {
  const double common = pair.contact_line_sense() * crossing * std::cos(pair.working_transverse_pressure_angle) / pair.gear_ratio();
  return {common * std::tan(pair.base_helix_angle), -common / std::tan(pair.base_helix_angle)};
}

/// The closing at an axial position as a wheel angle.
double closed_form_error(const GearPair& pair, double crossing, double phi1, double z) {
  const double b = pair.base_helix_angle;
  return crossing * std::cos(pair.working_transverse_pressure_angle) / (pair.wheel.base_radius * std::cos(b)) *
         (z / std::cos(b) + pair.contact_line_sense() * std::sin(b) * pair.pinion.base_radius * phi1);
}

double gain_off_plane(const GearPair& pair, double crossing, bool pinion_tip) {
  const double b = pair.base_helix_angle;
  const double rho1 = pinion_tip ? pair.path_end : pair.path_start, rho2 = pair.path_length - rho1;
  const double ratio = pinion_tip ? rho1 / pair.pinion.base_radius : rho2 / pair.wheel.base_radius;
  const double k = (1 / rho1 + 1 / rho2) * ratio * ratio;
  const double slope = crossing * std::cos(pair.working_transverse_pressure_angle) / std::sin(b);
  return slope * slope / (2 * k * std::cos(b)) / (pair.wheel.base_radius * std::cos(b));
}

}  // namespace

TEST_CASE("Crossed axes bring edges into contact with the closed form's two slopes", "[core][contact][closed-form][reference]") {
  const Hand hand = GENERATE(Hand::Left, Hand::Right);
  const double crossing = GENERATE(3.0, -3.0, 0.3) * arcmin;
  const GearPair pair = nasa_pair(hand);
  Misalignment misalignment;
  misalignment.crossing = crossing;
  const FlankAssembly scene = scene_of(pair, misalignment);
  const Slopes slopes = closed_form_slopes(pair, crossing);
  CAPTURE(pair.contact_line_sense(), crossing / arcmin);
  const double kModel = 3.0 * std::abs(crossing);  // model: slopes are of first order in the angle, relative
  int on_face = 0, on_tip = 0;
  for (double phi1 = -0.26; phi1 < 0.26; phi1 += 0.013) {
    const ToothContact here = find_tooth_contact(scene, 0, phi1), next = find_tooth_contact(scene, 0, phi1 + 1e-3);
    if (here.kind != next.kind) continue;
    // The wheel's end lies b/2 sin^2(a) gamma or so off the pinion's; both count as the same branch here.
    const double slope = (next.transmission_error - here.transmission_error) / 1e-3;
    CAPTURE(phi1, to_string(here.kind));
    if (here.kind == ContactKind::FaceEnd) {
      ++on_face;
      const double z = std::copysign(0.5 * pair.face_width, crossing);
      CHECK(std::abs(here.pinion_z - z) <= 0.1);  // mm, model: the tilted end face shifts by gamma times a tooth height or so
      const double te = closed_form_error(pair, crossing, phi1, here.pinion_z);
      CHECK(std::abs(here.transmission_error - te) <= kModel * std::abs(te));
      CHECK(std::abs(slope / slopes.face_end - 1) <= kModel);
    } else {
      const bool pinion_tip = here.kind == ContactKind::PinionTip;
      REQUIRE((pinion_tip || here.kind == ContactKind::WheelTip));
      ++on_tip;
      const double s = (pinion_tip ? pair.path_end : pair.path_start) - pair.pitch_point;
      const double z = (s - pair.pinion.base_radius * phi1) / (pair.contact_line_sense() * std::tan(pair.base_helix_angle));
      const double gain = gain_off_plane(pair, crossing, pinion_tip);
      const double te = closed_form_error(pair, crossing, phi1, z);
      CHECK(std::abs(here.transmission_error - te - gain) <= 0.2 * gain);  // model: the other terms of second order are smaller
      CHECK(std::abs(slope / slopes.tip - 1) <= kModel);
    }
  }
  CHECK(on_face >= 12);
  CHECK(on_tip >= 12);
}

TEST_CASE("Crossing and lead-angle error of 3 minutes give the same transmission error to first order", "[core][contact][reference]") {
  // Both tilt one gear's generating rack against the other's by the same angle in the pitch plane. The lead error
  // closes the mesh at +z on a left-hand pinion: its sign goes with the hand.
  const Hand hand = GENERATE(Hand::Left, Hand::Right);
  const GearPair pair = nasa_pair(hand);
  const int positions = 128;
  const double pitch = 2 * pi / pair.data.pinion.teeth;
  for (const double angle : {3 * arcmin, -3 * arcmin}) {
    Misalignment crossing, lead;
    crossing.crossing = angle;
    lead.pinion_lead_angle = -pair.contact_line_sense() * angle;
    const Slopes slopes = closed_form_slopes(pair, angle);
    const double m1 = std::abs(slopes.face_end), m2 = std::abs(slopes.tip);
    for (const Misalignment& misalignment : {crossing, lead}) {
      const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair, misalignment), positions);
      // model: 3 |angle| for the slopes; discretisation: the crest between two positions is missed by at most one
      // spacing.
      const double expected = pitch * m1 * m2 / (m1 + m2);
      CAPTURE(mesh.peak_to_peak / arcsec, expected / arcsec);
      CHECK(std::abs(mesh.peak_to_peak / expected - 1) <= 3 * std::abs(angle) + 1.0 / positions);
      CHECK(mesh.transfers.size() == 1);
      int near_face_end = 0, near_tip = 0;
      for (std::size_t i = 1; i < mesh.phi1.size(); ++i) {
        const double slope = (mesh.transmission_error[i] - mesh.transmission_error[i - 1]) / (pitch / positions);
        near_face_end += std::abs(slope / slopes.face_end - 1) <= 3 * std::abs(angle);
        near_tip += std::abs(slope / slopes.tip - 1) <= 3 * std::abs(angle);
      }
      // All but the intervals with crest and valley run on one of the two slopes, for times in the inverse ratio of
      // these.
      CHECK(near_face_end + near_tip >= positions - 6);
      CHECK(std::abs(near_face_end / (positions * m2 / (m1 + m2)) - 1) <= 0.08);
    }
  }
}

TEST_CASE("Crossing of 3 minutes is taken back by a lead-angle error of the opposite sign", "[core][contact][reference]") {
  const GearPair pair = nasa_pair(Hand::Left);
  Misalignment both;
  both.crossing = reference::nasa_tm_107451::error;
  both.pinion_lead_angle = -reference::nasa_tm_107451::error;
  CHECK(analyse_unloaded_mesh(pair, scene_of(pair, both), 48).peak_to_peak <= 1e-3 * arcsec);  // model: second order
  // A minute's difference is not forgiven (fig. 6).
  both.pinion_lead_angle = -4 * arcmin;
  CHECK(analyse_unloaded_mesh(pair, scene_of(pair, both), 48).peak_to_peak >= 1 * arcsec);
}

TEST_CASE("A pressure-angle error of 3 minutes causes no transmission error", "[core][contact][reference]") {
  // The flanks part towards one end of the profile; a helical pair with overlap always has a line that reaches the
  // other end, where the deviation is the same for all of them.
  const double error = GENERATE(1, -1) * reference::nasa_tm_107451::error;
  const GearPair pair = nasa_pair(Hand::Left);
  Misalignment misalignment;
  misalignment.pinion_pressure_angle = error;
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair, misalignment), 48);
  CHECK(mesh.peak_to_peak <= 1e-12);  // round-off, rad
  for (const PairCurve& curve : mesh.pairs) CHECK_FALSE(curve.positions.empty());
}

TEST_CASE("A rotation of the wheel in the plane of the axes acts through the pressure angle", "[core][contact][closed-form]") {
  // Spur gears: the wheel's flank turns by g about y, opening by g z sin(a) along the line of action: contact at the
  // end z < 0.
  const double angle = GENERATE(2.0, -2.0) * arcmin;
  const GearPair pair = make_gear_pair(pair_data(20, 40, 0.0));
  Misalignment misalignment;
  misalignment.intersecting = angle;
  const ToothContact contact = find_tooth_contact(scene_of(pair, misalignment), 0, 0.01);
  const double expected = std::abs(angle) * 15.0 * std::sin(pair.working_transverse_pressure_angle) / pair.wheel.base_radius;
  CHECK(contact.kind == ContactKind::FaceEnd);
  CHECK(contact.pinion_z * angle < 0.0);
  CHECK(std::abs(contact.transmission_error / expected - 1) <= 3 * std::abs(angle) + 2e-3);  // model: ends tilt by the angle
}

TEST_CASE("A mesh misalignment puts the flanks on edge by half of it", "[core][contact][closed-form]") {
  // F_beta_y is linear over the face and zero at the middle: the mesh closes at -z by F/2 along the base tangent.
  const double f = GENERATE(0.010, -0.006);
  const GearPair pair = make_gear_pair(pair_data(20, 40, 0.0, 0.2, 0.1, 30.0, 40.0));
  Misalignment misalignment;
  misalignment.mesh_misalignment = f;
  for (const double phi1 : {-0.05, 0.0, 0.05}) {
    const ToothContact contact = find_tooth_contact(scene_of(pair, misalignment), 0, phi1);
    CHECK(std::abs(contact.transmission_error - std::abs(f) / 2 / pair.wheel.base_radius) <= 1e-12);  // round-off
    CHECK(std::abs(contact.pinion_z + std::copysign(15.0, f)) <= 1e-9);
  }
}

TEST_CASE("The transmission error passes continuously through perfect alignment", "[core][contact]") {
  const double beta = GENERATE(0.0, 0.4);
  const GearPair pair = make_gear_pair(pair_data(23, 38, beta));
  // Largest closing of a unit angle on the flanks: half the face plus the tooth depth, over r_b2; both angles alike.
  const double reach = (15.0 + 15.0) / pair.wheel.base_radius;
  for (const double angle : {1e-4, 1e-7, 1e-10}) {
    for (const double sign : {1.0, -1.0}) {
      Misalignment misalignment;
      misalignment.crossing = sign * angle;
      misalignment.intersecting = -0.5 * sign * angle;
      for (const double phi1 : {-0.04, 0.0, 0.05}) {
        const ToothContact contact = find_tooth_contact(scene_of(pair, misalignment), 0, phi1);
        CHECK(contact.transmission_error >= -1e-12);  // round-off: mid face is not moved away by more than it is turned
        CHECK(contact.transmission_error <= 1.5 * reach * angle + 1e-12);
      }
    }
  }
}
