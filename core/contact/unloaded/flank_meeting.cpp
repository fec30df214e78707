#include "core/contact/unloaded/flank_meeting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flankwright {

FlankMeeting::Deviation::Deviation(const Flank& of, int tooth)
    : flank(of),
      formula(of.modification, tooth_error(of.error, tooth), of.frame),
      pitch(pitch_deviation(of.error, tooth)),
      measured(tooth_topography(of.error, tooth)),
      per_base_radius(1.0 / of.base_radius) {}

inline Dual<2> FlankMeeting::Deviation::at(double rho, double z) const {
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

FlankMeeting::FlankMeeting(const MeshScene& scene, int tooth, double phi1)
    : scene_(scene),
      pinion_(scene.pinion, tooth),
      wheel_(scene.wheel, tooth),
      pinion_origin_(scene.pinion.origin + (phi1 + tooth * 2.0 * units::pi / scene.pinion_teeth)),
      wheel_origin_(scene.wheel.origin - tooth * 2.0 * units::pi / scene.wheel_teeth) {
  // Undisturbed contact: where the pinion's base tangent is the line of action of the centre distance as it is.
  const double distance = scene.wheel_centre.head<2>().norm();
  const double bases = scene.pinion.base_radius + scene.wheel.base_radius, cosine = std::min(1.0, bases / distance);
  path_length_ = std::sqrt(std::max(0.0, (distance - bases) * (distance + bases)));
  roll_at_mid_face_ = scene.pinion.base_radius * (pinion_origin_ + std::acos(cosine));
}

double FlankMeeting::undisturbed_curvature(double rho1) const {
  const double rho2 = std::max(path_length_ - rho1, 0.01 * std::max(path_length_, rho1));
  return rho1 * (1.0 + rho1 / rho2) * pinion_.per_base_radius * pinion_.per_base_radius * wheel_.per_base_radius;
}

void FlankMeeting::place_point(Meeting& m) const {
  const Flank& pinion = scene_.pinion;
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
  m.place = scene_.wheel_axes.transpose() * (point - scene_.wheel_centre);
  m.wheel_z = m.place.z();
}

void FlankMeeting::move_onto_wheel_face(Meeting& m) const {
  const double end = std::copysign(scene_.wheel.half_face, m.wheel_z);
  m.on_wheel_end = true;
  // Newton on the all but linear wheel_z(z); the second step is round-off already.
  for (int i = 0; i < 3 && m.wheel_z != end; ++i) {
    m.z -= (m.wheel_z - end) / axial_gradient(m).z;
    place_point(m);
  }
}

Meeting FlankMeeting::at(double rho, double z, const Meeting* near) const {
  const Flank& wheel = scene_.wheel;
  const double rb2 = wheel.base_radius;
  Meeting m;
  m.rho = rho;
  m.z = z;
  place_point(m);
  if (std::abs(m.wheel_z) > wheel.half_face) move_onto_wheel_face(m);

  const double x = m.place.x(), y = m.place.y();
  m.wheel_radius = std::sqrt(x * x + y * y);
  const double radius = std::clamp(m.wheel_radius, rb2 * lowest_start, wheel.tip_radius);
  m.wheel_roll = std::sqrt((radius - rb2) * (radius + rb2));

  // Newton on rho2 - D(rho2, z2) = sqrt(r^2 - r_b^2); its last step is too short to change D or its slope. Where it
  // does not converge (kinks), the plain iteration does: |D'| < 1. Beyond the tip a relief goes on and may become
  // steeper than that; no point of the flank has such a radius then, and rho2 ends at its bound.
  const double negligible = 1e-7;      // mm: squared it is below round-off
  const double near_enough = 0.05;     // of the roll length: from further off no guess is taken
  const double lowest = 0.1 * m.wheel_roll;  // keeps clear of the cusp of the involute
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
  const Eigen::Vector3d rotation(radial * x - per_square * y, radial * y + per_square * x,
                                 -wheel.helix_rate + d.gradient[1] * stretch);
  m.turn = -(scene_.wheel_axes * rotation);
  if (m.on_wheel_end) {
    const MeetingGradient axial = axial_gradient(m);
    m.along_rho -= m.along_z * (axial.rho / axial.z);
    m.along_phi1 -= m.along_z * (axial.phi1 / axial.z);
  }
  m.angle = {m.turn.dot(m.along_rho), m.turn.dot(m.along_z), m.turn.dot(m.along_phi1)};
  return m;
}

double FlankMeeting::phi2(const Meeting& m) const {
  const double rb = scene_.wheel.base_radius, x = m.place.x(), y = m.place.y();
  const double polar = std::atan2(y * rb - x * m.wheel_roll, x * rb + y * m.wheel_roll);
  return wheel_origin_ + scene_.wheel.helix_rate * m.wheel_z - (m.wheel_roll + m.wheel_deviation) / rb - polar;
}

MeetingGradient FlankMeeting::radius_gradient(const Meeting& m) const {
  const Eigen::Vector3d outwards =
      scene_.wheel_axes * Eigen::Vector3d(m.place.x() / m.wheel_radius, m.place.y() / m.wheel_radius, 0.0);
  return {outwards.dot(m.along_rho), outwards.dot(m.along_z), outwards.dot(m.along_phi1)};
}

MeetingGradient FlankMeeting::axial_gradient(const Meeting& m) const {
  const Eigen::Vector3d axis = scene_.wheel_axes.col(2);
  return {axis.dot(m.along_rho), axis.dot(m.along_z), axis.dot(m.along_phi1)};
}

}  // namespace flankwright
