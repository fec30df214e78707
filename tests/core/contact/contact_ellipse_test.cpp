#include "core/contact/unloaded/contact_ellipse.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::deg;

namespace {

/// How far the flanks are apart along the contact normal at a displacement of the pinion's parameters from the point of
/// contact: the turn of the wheel that closes the gap times the speed of its flank along the normal. Knows nothing of
/// second derivatives.
double separation_at(const FlankAssembly& scene, const ToothContact& contact, double d_rho, double d_z) {
  const double rho = scene.pinion.roll_at(contact.pinion_radius), z = contact.pinion_z;
  const auto through = [&](double r, double at) { return wheel_angle(scene, contact.tooth, contact.phi1, r, at); };
  const SurfacePoint point = surface_point(scene.pinion, rho, z, contact.tooth, contact.phi1);
  const Eigen::Vector3d arm = point.position - scene.wheel_centre, axis = scene.wheel_axes.col(2);
  const double normal_speed = std::abs(axis.cross(arm).dot(point.normal));
  // Both sides together: a point of contact known to a few nm has a slope that would drown the second order.
  return (through(rho, z) - 0.5 * (through(rho + d_rho, z + d_z) + through(rho - d_rho, z - d_z))) * normal_speed;
}

}  // namespace

TEST_CASE("Aligned involutes touch along a line, with the closed form's curvature across it", "[core][contact][closed-form]") {
  const double beta = GENERATE(0.0, 14.0, 30.0) * deg;
  const Hand hand = GENERATE(Hand::Right, Hand::Left);
  PairData data = pair_data(24, 61, beta, 0.2, -0.1);
  data.pinion_hand = hand;
  const GearPair pair = make_gear_pair(data);
  const FlankAssembly scene = scene_of(pair);
  for (const double phi1 : {-0.08, 0.0, 0.05}) {
    const ToothContact contact = find_tooth_contact(scene, 0, phi1);
    REQUIRE(contact.kind == ContactKind::Line);
    const ContactEllipse ellipse = contact_ellipse(scene, contact, 0.006);
    const double rho1 = pair.pinion.roll_length_at(contact.pinion_radius), rho2 = pair.path_length - rho1;
    const double across = (1 / rho1 + 1 / rho2) * std::cos(pair.base_helix_angle);
    CAPTURE(beta / deg, phi1);
    CHECK(std::abs(ellipse.greatest_curvature / across - 1) <= 1e-10);  // round-off: a point of contact known to 1e-10 mm
    CHECK(std::abs(ellipse.least_curvature) <= 1e-12 * across);         // round-off of the two surfaces' curvatures
    CHECK(std::isinf(ellipse.semi_major));
    CHECK(std::abs(ellipse.semi_minor - std::sqrt(0.012 / across)) <= 1e-10);
    // The line of contact on the flank is the generator d(rho)/d(z) = r_b s/p, one unit of length along it.
    CHECK(std::abs(ellipse.major_d_rho - pair.pinion.base_radius * scene.pinion.helix_rate * ellipse.major_d_z) <= 1e-10);
    CHECK(std::abs(ellipse.major_d_z - std::cos(pair.base_helix_angle)) <= 1e-10);
  }
}

TEST_CASE("A pitch deviation turns a flank and leaves its curvature", "[core][contact][closed-form]") {
  const GearPair pair = make_gear_pair(pair_data(24, 61, 14 * deg));
  ManufacturingError pinion, wheel;
  (GENERATE(true, false) ? pinion : wheel).cumulative_pitch = {0.2};
  const FlankAssembly scene = assemble_flanks(pair, {.error = {pinion, wheel}});
  const ToothContact contact = find_tooth_contact(scene, 0, 0.03);
  REQUIRE(contact.kind == ContactKind::Line);
  // The involute's radius of curvature is that of the place, whatever parameter the flank gives it.
  const double rho2 = pair.wheel.roll_length_at(contact.wheel_radius), rho1 = pair.path_length - rho2;
  const double across = (1 / rho1 + 1 / rho2) * std::cos(pair.base_helix_angle);
  CHECK(std::abs(contact_ellipse(scene, contact, 0.006).greatest_curvature / across - 1) <= 1e-9);  // round-off
}

TEST_CASE("A lead-crowned spur pair is curved along the face by its crowning", "[core][contact][closed-form]") {
  // D = 4 C (z/b)^2 along the normal: kappa_1 = 8 C/b^2, from either gear, and the crownings of both add up.
  const double c1 = GENERATE(0.0, 0.008, 0.030), c2 = GENERATE(0.004, 0.015), thickness = 0.006;
  const GearPair pair = make_gear_pair(pair_data(20, 40, 0.0, 0.0, 0.0, 30.0, 26.0));
  Modification pinion, wheel;
  pinion.lead_crowning = c1;
  wheel.lead_crowning = c2;
  const FlankAssembly scene = scene_of(pair, {}, pinion, wheel);
  const ToothContact contact = find_tooth_contact(scene, 0, 0.03);
  REQUIRE(contact.kind == ContactKind::Surface);
  const ContactEllipse ellipse = contact_ellipse(scene, contact, thickness);
  const double along = 8 * c1 / (30.0 * 30.0) + 8 * c2 / (26.0 * 26.0);
  CHECK(std::abs(ellipse.least_curvature / along - 1) <= 1e-9);  // round-off of curvatures 1000 times as large
  CHECK(std::abs(ellipse.semi_major / std::sqrt(2 * thickness / along) - 1) <= 1e-9);
  CHECK(std::abs(ellipse.major_d_z - 1) <= 1e-9);
  CHECK(std::abs(ellipse.major_d_rho) <= 1e-6);
  // Across the line of contact rho_1 d(rho)/r_b is a length.
  const double rho1 = scene.pinion.roll_at(contact.pinion_radius);
  CHECK(std::abs(ellipse.minor_d_rho * rho1 / pair.pinion.base_radius - 1) <= 1e-6);  // model: profile unmodified but for the crown's D
}

TEST_CASE("The ellipse describes the gap that a direct evaluation finds around the point of contact", "[core][contact][independent]") {
  const Hand hand = GENERATE(Hand::Left, Hand::Right);
  PairData data = reference::nasa_tm_107451::pair_data();
  data.pinion_hand = hand;
  const GearPair pair = make_gear_pair(data);
  Modification pinion, wheel;
  pinion.lead_crowning = 0.030;
  pinion.addendum_crowning = pinion.dedendum_crowning = 0.020;
  pinion.twist = 0.008;
  wheel.lead_crowning = 0.012;
  wheel.parabolic_te = 2e-4;
  int compared = 0;
  for (const double crossing : {0.0, 1.5, -1.0}) {
    Misalignment misalignment;
    misalignment.crossing = crossing * arcmin;
    misalignment.intersecting = 0.8 * arcmin;
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    for (const double phi1 : {-0.06, 0.02, 0.07}) {
      const ToothContact contact = find_tooth_contact(scene, 0, phi1);
      if (contact.kind != ContactKind::Surface) continue;
      ++compared;
      const ContactEllipse e = contact_ellipse(scene, contact, 0.001);
      CAPTURE(crossing, phi1, e.least_curvature, e.greatest_curvature);
      REQUIRE(e.least_curvature > 0.0);
      CHECK(e.least_curvature < e.greatest_curvature);
      for (const double angle : {0.0, 30.0, 90.0, 135.0}) {
        const double s1 = e.semi_major * std::cos(angle * deg), s2 = e.semi_minor * std::sin(angle * deg);
        // discretisation: the fourth order over a tenth of an axis
        const double share = 0.1;
        const double gap =
            separation_at(scene, contact, share * (s1 * e.major_d_rho + s2 * e.minor_d_rho), share * (s1 * e.major_d_z + s2 * e.minor_d_z));
        CHECK(std::abs(gap / (0.001 * share * share) - 1) <= 1e-5);
      }
      // Unit lengths, at right angles.
      const double rho = scene.pinion.roll_at(contact.pinion_radius);
      const SurfacePoint p = surface_point(scene.pinion, rho, contact.pinion_z, 0, phi1);
      const Eigen::Vector3d major = e.major_d_rho * p.d_rho + e.major_d_z * p.d_z;
      const Eigen::Vector3d minor = e.minor_d_rho * p.d_rho + e.minor_d_z * p.d_z;
      CHECK(std::abs(major.norm() - 1) <= 1e-12);
      CHECK(std::abs(minor.norm() - 1) <= 1e-12);
      CHECK(std::abs(major.dot(minor)) <= 1e-12);
      CHECK(e.major_d_z > 0.0);
      CHECK(e.minor_d_rho > 0.0);
    }
  }
  CHECK(compared >= 7);
}

TEST_CASE("The ellipse grows with the square root of the compound's thickness", "[core][contact][closed-form]") {
  const GearPair pair = make_gear_pair(pair_data(22, 51, 17 * deg));
  Modification m;
  m.lead_crowning = 0.012;
  const FlankAssembly scene = scene_of(pair, {}, m);
  const ToothContact contact = find_tooth_contact(scene, 0, 0.02);
  const ContactEllipse thin = contact_ellipse(scene, contact, 0.002), thick = contact_ellipse(scene, contact, 0.018);
  CHECK(std::abs(thick.semi_major / thin.semi_major - 3) <= 1e-14);
  CHECK(std::abs(thick.semi_minor / thin.semi_minor - 3) <= 1e-14);
  CHECK(thick.major_d_rho == thin.major_d_rho);
}

TEST_CASE("A hollow lead is a saddle: open along the face, closed across", "[core][contact][closed-form]") {
  // Touching at mid face is not the first contact here; the shape of the gap is what it is.
  const GearPair pair = make_gear_pair(pair_data(20, 40, 0.0));
  Modification m;
  m.lead_crowning = -0.010;
  ToothContact contact = find_tooth_contact(scene_of(pair), 0, 0.02);
  contact.pinion_z = contact.wheel_z = 0.0;
  const ContactEllipse ellipse = contact_ellipse(scene_of(pair, {}, m), contact, 0.006);
  CHECK(std::abs(ellipse.least_curvature / (-8 * 0.010 / 900.0) - 1) <= 1e-9);
  CHECK(std::isinf(ellipse.semi_major));
  CHECK(std::isfinite(ellipse.semi_minor));
}

TEST_CASE("Edges have no ellipse, and a compound has a thickness", "[core][contact]") {
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  Misalignment misalignment;
  misalignment.crossing = 3 * arcmin;
  const FlankAssembly scene = scene_of(pair, misalignment);
  const ToothContact contact = find_tooth_contact(scene, 0, 0.0);
  REQUIRE(contact.kind == ContactKind::FaceEnd);
  const ContactEllipse ellipse = contact_ellipse(scene, contact, 0.006);
  CHECK(std::isnan(ellipse.greatest_curvature));
  CHECK(std::isnan(ellipse.semi_minor));
  CHECK(std::isnan(contact_ellipse(scene, ToothContact{}, 0.006).semi_minor));
  CHECK_THROWS_AS(contact_ellipse(scene, contact, 0.0), InvalidInput);
  CHECK_THROWS_AS(contact_ellipse(scene, contact, NAN), InvalidInput);
}
