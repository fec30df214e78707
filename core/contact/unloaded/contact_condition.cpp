#include "core/contact/unloaded/contact_condition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flankwright {

ContactCondition::Deviation::Deviation(const Flank& of, int tooth)
    : flank(of),
      formula(of.modification, tooth_error(of.error, tooth), of.frame),
      pitch(pitch_deviation(of.error, tooth)),
      measured(tooth_topography(of.error, tooth)),
      per_base_radius(1.0 / of.base_radius) {}

inline Dual<2> ContactCondition::Deviation::at(double rho, double z) const {
  const double r = std::sqrt(rho * rho + flank.base_radius * flank.base_radius);
  const Jet of_formula = formula.at(r, z);
  Dual<2> d{of_formula.value - pitch, {of_formula.u * (rho / r), of_formula.v}};
  const auto add = [&](const DeviationField& field) {
    const Jet of_field = field.at(rho, z);
    d += Dual<2>{of_field.value, {of_field.u, of_field.v}};
  };
  for (const auto& field : flank.fields) add(*field);
  if (measured != nullptr) add(*measured);
  return d;
}

ContactCondition::ContactCondition(const FlankAssembly& assembly, int tooth, double phi1)
    : assembly_(assembly),
      pinion_(assembly.pinion, tooth),
      wheel_(assembly.wheel, tooth),
      pinion_origin_(assembly.pinion.origin + (phi1 + tooth * 2.0 * units::pi / assembly.pinion_teeth)),
      wheel_origin_(assembly.wheel.origin - tooth * 2.0 * units::pi / assembly.wheel_teeth) {
  // Undisturbed contact: where the pinion's base tangent is the line of action of the centre distance as it is.
  const double distance = assembly.wheel_centre.head<2>().norm();
  const double bases = assembly.pinion.base_radius + assembly.wheel.base_radius, cosine = std::min(1.0, bases / distance);
  path_length_ = std::sqrt(std::max(0.0, (distance - bases) * (distance + bases)));
  roll_at_mid_face_ = assembly.pinion.base_radius * (pinion_origin_ + std::acos(cosine));
}

double ContactCondition::undisturbed_curvature(double rho1) const {
  const double rho2 = std::max(path_length_ - rho1, 0.01 * std::max(path_length_, rho1));
  return rho1 * (1.0 + rho1 / rho2) * pinion_.per_base_radius * pinion_.per_base_radius * wheel_.per_base_radius;
}

void ContactCondition::locate_point(FlankContact& m) const {
  const Flank& pinion = assembly_.pinion;
  const double rb = pinion.base_radius, turn = pinion.helix_rate;
  const Dual<2> removed = pinion_.at(m.rho, m.z);
  const double theta = pinion_origin_ + turn * m.z - m.rho * pinion_.per_base_radius;
  const double c = std::cos(theta), s = std::sin(theta);
  const double along = m.rho - removed.value;
  const Eigen::Vector3d point(rb * c - along * s, rb * s + along * c, m.z);
  // Components along the radial (c, s) and the tangential (-s, c) direction.
  const double rho_t = -removed.gradient[0], rho_e = along * pinion_.per_base_radius;
  const double z_t = rb * turn - removed.gradient[1], z_e = -along * turn;
  m.along_rho = {rho_e * c - rho_t * s, rho_e * s + rho_t * c, 0.0};
  m.along_z = {z_e * c - z_t * s, z_e * s + z_t * c, 1.0};
  m.along_phi1 = {-point.y(), point.x(), 0.0};
  m.point = assembly_.wheel_axes.transpose() * (point - assembly_.wheel_centre);
  m.wheel_z = m.point.z();
}

void ContactCondition::move_onto_wheel_face(FlankContact& m) const {
  const double end = assembly_.wheel.face.end_near(m.wheel_z);
  m.on_wheel_end = true;
  // Newton on the all but linear wheel_z(z); the second step is round-off already.
  for (int i = 0; i < 3 && m.wheel_z != end; ++i) {
    m.z -= (m.wheel_z - end) / axial_gradient(m).z;
    locate_point(m);
  }
}

FlankContact ContactCondition::at(double rho, double z, const FlankContact* near) const {
  const Flank& wheel = assembly_.wheel;
  const double rb2 = wheel.base_radius;
  FlankContact m;
  m.rho = rho;
  m.z = z;
  locate_point(m);
  if (!wheel.face.holds(m.wheel_z)) move_onto_wheel_face(m);

  const double x = m.point.x(), y = m.point.y();
  m.wheel_radius = std::sqrt(x * x + y * y);
  const double radius = std::clamp(m.wheel_radius, rb2 * lowest_start, wheel.tip_radius);
  m.wheel_roll = std::sqrt((radius - rb2) * (radius + rb2));

  // Newton on rho2 - D(rho2, z2) = sqrt(r^2 - r_b^2); its last step is too short to change D or its slope. Where it
  // does not converge (kinks), the plain iteration does: |D'| < 1. Beyond the tip a relief goes on and may become
  // steeper than that; no point of the flank has such a radius then, and rho2 ends at its bound.
  const double negligible = 1e-7;              // mm: squared it is below round-off
  const double near_enough = 0.05;             // of the roll length: from further off no guess is taken
  const double lowest = 0.1 * m.wheel_roll;    // keeps clear of the cusp of the involute
  const double highest = 10.0 * m.wheel_roll;  // and of overflow
  double rho2 = m.wheel_roll, last_step = std::numeric_limits<double>::infinity();
  if (near && std::abs(m.wheel_roll - near->wheel_roll) <= near_enough * m.wheel_roll) {
    rho2 += near->wheel_deviation + near->deviation_slope * (m.wheel_roll - near->wheel_roll);
    rho2 = std::clamp(rho2, lowest, highest);
  }
  Dual<2> d;
  double pace = 1.0;  // d(rho2)/d(sqrt(r^2 - r_b^2))
  for (int i = 0; i < 100; ++i) {
    d = wheel_.at(rho2, m.wheel_z);
    pace = 1.0 / (1.0 - d.gradient[0]);
    double step = rho2 - d.value - m.wheel_roll;
    if (std::abs(step) < 0.5 * last_step) step *= pace;
    rho2 = std::clamp(rho2 - step, lowest, highest);
    last_step = std::abs(step);
    if (last_step <= negligible) break;
  }
  m.wheel_deviation = rho2 - m.wheel_roll;
  m.deviation_slope = d.gradient[0] * pace;

  // Gradient of the wheel's rotation with respect to the point, wheel frame; phi2 turns the other way.
  const double stretch = pace * wheel_.per_base_radius, per_square = 1.0 / (radius * radius);
  const double radial = (stretch - rb2 * per_square) / m.wheel_roll;
  const Eigen::Vector3d rotation(radial * x - per_square * y, radial * y + per_square * x, -wheel.helix_rate + d.gradient[1] * stretch);
  m.turn = -(assembly_.wheel_axes * rotation);
  if (m.on_wheel_end) {
    const ContactGradient axial = axial_gradient(m);
    m.along_rho -= m.along_z * (axial.rho / axial.z);
    m.along_phi1 -= m.along_z * (axial.phi1 / axial.z);
  }
  m.angle = {m.turn.dot(m.along_rho), m.turn.dot(m.along_z), m.turn.dot(m.along_phi1)};
  return m;
}

double ContactCondition::phi2(const FlankContact& m) const {
  const double rb = assembly_.wheel.base_radius, x = m.point.x(), y = m.point.y();
  const double polar = std::atan2(y * rb - x * m.wheel_roll, x * rb + y * m.wheel_roll);
  return wheel_origin_ + assembly_.wheel.helix_rate * m.wheel_z - (m.wheel_roll + m.wheel_deviation) / rb - polar;
}

ContactGradient ContactCondition::radius_gradient(const FlankContact& m) const {
  const Eigen::Vector3d outwards = assembly_.wheel_axes * Eigen::Vector3d(m.point.x() / m.wheel_radius, m.point.y() / m.wheel_radius, 0.0);
  return {outwards.dot(m.along_rho), outwards.dot(m.along_z), outwards.dot(m.along_phi1)};
}

ContactGradient ContactCondition::axial_gradient(const FlankContact& m) const {
  const Eigen::Vector3d axis = assembly_.wheel_axes.col(2);
  return {axis.dot(m.along_rho), axis.dot(m.along_z), axis.dot(m.along_phi1)};
}

}  // namespace flankwright
