#pragma once

#include <cmath>
#include <limits>

#include "core/contact/assembly/flank_assembly.hpp"
#include "core/contact/path/contact_points.hpp"
#include "core/contact/path/path_of_contact.hpp"
#include "core/contact/unloaded/tooth_contact.hpp"
#include "core/contact/unloaded/transmission_error.hpp"
#include "tests/common/random.hpp"

/// What the tests of unloaded contact share: pairs, scenes and an evaluation that knows nothing of the solver.
namespace flankwright::contact_cases {

/// A pair that leaves the wheel's teeth room; x1, x2 profile shifts, widths in mm.
inline PairData pair_data(int z1, int z2, double beta, double x1 = 0.0, double x2 = 0.0, double b1 = 30.0, double b2 = 30.0) {
  PairData data;
  data.normal_module = 3.0;
  data.helix_angle = beta;
  data.pinion.teeth = z1;
  data.wheel.teeth = z2;
  data.pinion.profile_shift = x1;
  data.wheel.profile_shift = x2;
  data.pinion.face_width = b1;
  data.wheel.face_width = b2;
  return data;
}

inline FlankAssembly scene_of(const GearPair& pair, const Misalignment& misalignment = {}, const Modification& pinion = {},
                              const Modification& wheel = {}) {
  return assemble_flanks(pair, {.modification = {pinion, wheel}, .misalignment = misalignment});
}

/// The gap of both flanks where the undisturbed ones would touch, as classical load distribution takes it: what is removed from either gear at the point
/// itself, with no search for a place where less is. Without misalignment and predesigned parabolas.
inline double undisturbed_gap(const GearPair& pair, const ContactPoint& point, const FlankCondition& condition) {
  const auto deviation = [&](Member m, double radius) {
    const Flank flank = make_flank(pair, m, condition.modification[m], condition.error[m]);
    return flank.deviation(flank.roll_at(radius), point.z, point.tooth);
  };
  const double removed = deviation(Member::Pinion, point.pinion_radius) + deviation(Member::Wheel, point.wheel_radius);
  return point.clearance + std::cos(pair.base_helix_angle) * removed;
}

/// Wheel angle at which the wheel's flank passes through one point of the pinion's flank; -infinity where the point
/// lies outside the wheel's flank.
inline double wheel_angle(const FlankAssembly& scene, int tooth, double phi1, double rho, double z) {
  const Point3<double> p = flank_point(scene.pinion, rho, z, tooth, phi1 + tooth * 2.0 * units::pi / scene.pinion_teeth);
  const Eigen::Vector3d q = scene.wheel_axes.transpose() * (Eigen::Vector3d(p.x, p.y, p.z) - scene.wheel_centre);
  const double radius = q.head<2>().norm();
  if (radius > scene.wheel.tip_radius || radius < scene.wheel.form_radius || std::abs(q.z()) > scene.wheel.face.half()) {
    return -std::numeric_limits<double>::infinity();
  }
  const FlankThroughPoint<double> through = rotation_through(scene.wheel, Point3<double>{q.x(), q.y(), q.z()}, tooth);
  return -through.rotation - tooth * 2.0 * units::pi / scene.wheel_teeth;
}

/// The largest wheel angle that any point of a grid over the pinion's flank asks for; -infinity where none meets the
/// wheel's flank.
inline double highest_on_grid(const FlankAssembly& scene, double phi1, int intervals) {
  double highest = -std::numeric_limits<double>::infinity();
  const double lo = scene.pinion.lowest_roll(), hi = scene.pinion.highest_roll();
  for (int i = 0; i <= intervals; ++i) {
    for (int j = 0; j <= intervals; ++j) {
      const double z = scene.pinion.face.half() * (2.0 * j / intervals - 1.0);
      highest = std::max(highest, wheel_angle(scene, 0, phi1, lo + (hi - lo) * i / intervals, z));
    }
  }
  return highest;
}

using tests::Random;

/// A modification whose amounts a designer might choose for teeth of 3 mm module.
inline Modification random_modification(Random& random, const Gear& gear) {
  Modification m;
  const double um = units::um;
  m.lead_crowning = random.coin() ? random(0.0, 20 * um) : 0.0;
  m.lead_slope = random(-10 * um, 10 * um);
  m.addendum_crowning = random(0.0, 15 * um);
  m.dedendum_crowning = random(0.0, 15 * um);
  m.profile_slope = random(-8 * um, 8 * um);
  const double height = gear.tip_radius - gear.active_root_radius;
  const auto shape = [&] { return random.coin() ? ReliefShape::Linear : ReliefShape::Parabolic; };
  if (random.coin()) m.tip_relief = {random(0.0, 40 * um), random(0.1, 0.4) * height, shape()};
  if (random.coin()) m.root_relief = {random(0.0, 30 * um), random(0.1, 0.3) * height, shape()};
  if (random.coin()) m.end_relief = {random(0.0, 20 * um), random(0.05, 0.3) * gear.data.face_width};
  m.twist = random(-10 * um, 10 * um);
  return m;
}

inline Misalignment random_misalignment(Random& random) {
  Misalignment m;
  m.crossing = random(-5, 5) * units::arcmin;
  m.intersecting = random(-5, 5) * units::arcmin;
  m.centre_distance = random(-0.05, 0.2);
  m.axial_offset = random(-2.0, 2.0);
  m.pinion_lead_angle = random.coin() ? random(-3, 3) * units::arcmin : 0.0;
  m.pinion_pressure_angle = random.coin() ? random(-3, 3) * units::arcmin : 0.0;
  m.mesh_misalignment = random(-20, 20) * units::um;
  return m;
}

inline PairData random_pair_data(Random& random) {
  // One statement each: the order in which arguments are evaluated is the compiler's choice.
  const int z1 = random.integer(17, 40), z2 = random.integer(25, 90);
  const double beta = random.coin() ? random(0.0, 35 * units::deg) : 0.0;
  const double x1 = random(-0.1, 0.5), x2 = random(-0.3, 0.3), b1 = random(15.0, 45.0), b2 = random(15.0, 45.0);
  PairData data = pair_data(z1, z2, beta, x1, x2, b1, b2);
  data.pinion_hand = random.coin() ? Hand::Right : Hand::Left;
  data.working_flank = random.coin() ? WorkingFlank::Right : WorkingFlank::Left;
  return data;
}

}  // namespace flankwright::contact_cases
