#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;

namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// TM-107451, eqs 1 to 3: same point, same normal. Unknowns (rho1, z1, rho2, z2, phi2). Equal unit normals are
/// two equations: the wheel's normal is orthogonal to both tangents of the pinion.
Vector5 tangency_residual(const FlankAssembly& scene, double phi1, const Vector5& x) {
  const SurfacePoint on_pinion = surface_point(scene.pinion, x[0], x[1], 0, phi1);
  const SurfacePoint on_wheel = surface_point(scene.wheel, x[2], x[3], 0, -x[4]);
  const Eigen::Vector3d apart = on_pinion.position - (scene.wheel_axes * on_wheel.position + scene.wheel_centre);
  const Eigen::Vector3d normal = scene.wheel_axes * on_wheel.normal;
  Vector5 residual;
  residual << apart, 100.0 * normal.dot(on_pinion.d_rho.normalized()), 100.0 * normal.dot(on_pinion.d_z.normalized());
  return residual;
}

/// Newton's method; its Jacobian by central differences, which costs a few more steps and no accuracy.
Vector5 solve_tangency(const FlankAssembly& scene, double phi1, Vector5 x) {
  for (int step = 0; step < 40; ++step) {
    Matrix5 jacobian;
    for (int i = 0; i < 5; ++i) {
      const double h = i == 4 ? 1e-6 : 1e-4;
      Vector5 up = x, down = x;
      up[i] += h;
      down[i] -= h;
      jacobian.col(i) = (tangency_residual(scene, phi1, up) - tangency_residual(scene, phi1, down)) / (2 * h);
    }
    const Vector5 change = jacobian.fullPivLu().solve(tangency_residual(scene, phi1, x));
    x -= change;
    if (change.norm() < 1e-11) break;
  }
  return x;
}

}  // namespace

TEST_CASE("Surface contact solves Litvin's five equations of tangency", "[core][contact][independent]") {
  constexpr double kRoundOff = 1e-12;  // rad
  const Hand hand = GENERATE(Hand::Left, Hand::Right);
  PairData data = reference::nasa_tm_107451::pair_data();
  data.pinion_hand = hand;
  const GearPair pair = make_gear_pair(data);
  // High crowns in both directions make contact a well-conditioned point.
  Modification pinion, wheel;
  pinion.lead_crowning = 0.040;
  pinion.addendum_crowning = pinion.dedendum_crowning = 0.030;
  wheel.lead_crowning = 0.010;
  wheel.addendum_crowning = wheel.dedendum_crowning = 0.008;
  wheel.lead_slope = 0.004;
  pinion.twist = 0.006;
  int compared = 0;
  for (const double crossing : {0.0, 1.0 * arcmin, -2.0 * arcmin}) {
    Misalignment misalignment;
    misalignment.crossing = crossing;
    misalignment.intersecting = 0.7 * arcmin;
    misalignment.centre_distance = 0.02;
    misalignment.pinion_lead_angle = -0.5 * arcmin;
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    for (double phi1 = -0.12; phi1 < 0.13; phi1 += 0.02) {
      const ToothContact contact = find_tooth_contact(scene, 0, phi1);
      if (contact.kind != ContactKind::Surface) continue;
      // At the pitch circles the crowns' second derivatives jump: no kink, but Newton may step across.
      Vector5 start;
      start << scene.pinion.roll_at(contact.pinion_radius) + 0.05, contact.pinion_z - 0.2, scene.wheel.roll_at(contact.wheel_radius) - 0.05,
          contact.wheel_z + 0.1, contact.phi2 - 1e-5;
      const Vector5 x = solve_tangency(scene, phi1, start);
      CAPTURE(crossing / arcmin, phi1, x.transpose());
      REQUIRE(tangency_residual(scene, phi1, x).norm() <= 1e-9);
      CHECK(std::abs(x[4] - contact.phi2) <= kRoundOff);
      CHECK(std::abs(x[1] - contact.pinion_z) <= 1e-6);  // mm: a maximum's place is known to its root of round-off only
      CHECK(std::abs(x[3] - contact.wheel_z) <= 1e-6);
      CHECK(std::abs(std::hypot(scene.pinion.base_radius, x[0]) - contact.pinion_radius) <= 1e-6);
      ++compared;
    }
  }
  CHECK(compared >= 25);
}

TEST_CASE("Contact inside the flanks of random modified, misaligned gears solves the five equations of tangency", "[core][contact][independent]") {
  constexpr double kRoundOff = 1e-12;  // rad
  Random random(31415);
  int compared = 0;
  for (int scenes = 0; scenes < 40;) {
    const PairData data = random_pair_data(random);
    if (!find_problems(data).empty()) continue;
    ++scenes;
    const GearPair pair = make_gear_pair(data);
    const Misalignment misalignment = random_misalignment(random);
    // Crowned in both directions: contact is a point. Without linear reliefs, on whose kinks there is no tangency.
    const auto crowned = [&](const Gear& gear) {
      Modification m = random_modification(random, gear);
      m.lead_crowning += 0.015;
      m.addendum_crowning += 0.010;
      m.dedendum_crowning += 0.010;
      m.tip_relief = m.root_relief = {};
      m.end_relief = {};
      return m;
    };
    const Modification pinion = crowned(pair.pinion), wheel = crowned(pair.wheel);
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    for (int i = 0; i < 5; ++i) {
      const double phi1 = random(-0.5, 0.5) * pair.total_contact_ratio() * 2 * units::pi / data.pinion.teeth;
      const ToothContact contact = find_tooth_contact(scene, 0, phi1);
      if (contact.kind != ContactKind::Surface) continue;
      Vector5 start;
      start << scene.pinion.roll_at(contact.pinion_radius) + 0.01, contact.pinion_z - 0.05, scene.wheel.roll_at(contact.wheel_radius) - 0.01,
          contact.wheel_z + 0.03, contact.phi2 - 1e-6;
      const Vector5 x = solve_tangency(scene, phi1, start);
      CAPTURE(scenes, phi1, x.transpose());
      REQUIRE(tangency_residual(scene, phi1, x).norm() <= 1e-9);
      CHECK(std::abs(x[4] - contact.phi2) <= kRoundOff);
      ++compared;
    }
  }
  CHECK(compared >= 60);
}
