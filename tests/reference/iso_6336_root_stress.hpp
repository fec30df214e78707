#pragma once

#include <cmath>

#include "core/base/units.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright::test {

/// Nominal root stress of a spur gear under the whole load at its tip, ISO 6336-3, method B (Y_F and Y_S at the 30 deg
/// tangent), lengths in modules.
struct Iso6336Root {
  double chord;       ///< s_Fn
  double lever;       ///< h_Fa
  double form;        ///< Y_F
  double correction;  ///< Y_S
  double stress;      ///< sigma_F0 b m / F [-], F the force normal to the flank, F_t = F cos(alpha)
};

/// The trochoid that the rack's tip rounding, its centre at the depth G below the rolling line, leaves behind: the
/// angle theta between the tooth's centre line and the line to that centre when the tangent is at 30 deg solves theta =
/// 2 G tan(theta)/z - H.
inline Iso6336Root iso_6336_root(const GearData& gear, double alpha) {
  const double z = gear.teeth, x = gear.profile_shift;
  const double rho = gear.rack.root_radius, depth = gear.rack.dedendum, addendum = gear.rack.addendum;
  const double E = units::pi / 4 - depth * std::tan(alpha) - (1 - std::sin(alpha)) * rho / std::cos(alpha);
  const double G = rho - depth + x;
  const double H = 2 / z * (units::pi / 2 - E) - units::pi / 3;
  double theta = units::pi / 6;
  for (int i = 0; i < 100; ++i) theta = 2 * G / z * std::tan(theta) - H;

  Iso6336Root root{};
  root.chord = z * std::sin(units::pi / 3 - theta) + std::sqrt(3.0) * (G / std::cos(theta) - rho);
  const double curvature_radius = rho + 2 * G * G / (std::cos(theta) * (z * std::pow(std::cos(theta), 2) - 2 * G));

  // At the tip the force makes the angle alpha_F with the line across the tooth.
  const double tip = z + 2 * (addendum + x);
  const double alpha_tip = std::acos(z * std::cos(alpha) / tip);
  const auto involute = [](double a) { return std::tan(a) - a; };
  const double gamma = (units::pi / 2 + 2 * x * std::tan(alpha)) / z + involute(alpha) - involute(alpha_tip);
  const double alpha_F = alpha_tip - gamma;
  root.lever =
      0.5 * ((std::cos(gamma) - std::sin(gamma) * std::tan(alpha_F)) * tip - z * std::cos(units::pi / 3 - theta) - G / std::cos(theta) + rho);
  root.form = 6 * root.lever * std::cos(alpha_F) / (root.chord * root.chord * std::cos(alpha));
  const double L = root.chord / root.lever, q = root.chord / (2 * curvature_radius);
  root.correction = (1.2 + 0.13 * L) * std::pow(q, 1 / (1.21 + 2.3 / L));
  root.stress = std::cos(alpha) * root.form * root.correction;
  return root;
}

}  // namespace flankwright::test
