#include "core/contact/path/edge_extension.hpp"

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/path/path_of_contact.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

Eigen::Vector2d turned(const Eigen::Vector2d& p, double angle) {
  return {p.x() * std::cos(angle) - p.y() * std::sin(angle), p.x() * std::sin(angle) + p.y() * std::cos(angle)};
}

/// Distance of the pinion's tip edge from the wheel's flank along the wheel's base tangent, `beyond` mm of the path of contact after E. In coordinates: the pinion's
/// centre is the origin, the wheel's at (a, 0); the flank is the involute that passes through E at first.
double gap_of_pinion_edge(const GearPair& pair, double beyond) {
  const double r_b1 = pair.pinion.base_radius, r_b2 = pair.wheel.base_radius, alpha = pair.working_transverse_pressure_angle;
  const double rho = std::sqrt(std::pow(pair.pinion.tip_form_radius, 2) - r_b1 * r_b1);
  const Eigen::Vector2d centre(pair.centre_distance, 0),
      end(r_b1 * std::cos(alpha) + rho * std::sin(alpha), r_b1 * std::sin(alpha) - rho * std::cos(alpha));
  const Eigen::Vector2d edge = turned(turned(end, -beyond / r_b1) - centre, -beyond / r_b2), before = end - centre;  // in the wheel's frame
  const auto involute = [&](const Eigen::Vector2d& p) { return std::sqrt(p.squaredNorm() / (r_b2 * r_b2) - 1) - std::acos(r_b2 / p.norm()); };
  const auto polar = [](const Eigen::Vector2d& p) { return std::atan2(-p.y(), -p.x()); };  // from the line of centres
  return r_b2 * (polar(before) + involute(edge) - involute(before) - polar(edge));
}

}  // namespace

TEST_CASE("The extended path ends where a tip edge is further away than a tooth pair deflects", "[core][contact]") {
  const auto [z1, z2, helix] = GENERATE(table<int, int, double>({{60, 80, 0.0}, {100, 150, 0.0}, {180, 240, 20.0}, {240, 1000, 0.0}}));
  const GearPair pair = mesh_cases::pair(z1, z2, helix, 2, 20);
  const EdgeExtension extension = edge_extension(pair);
  CAPTURE(z1, z2, extension.before, extension.beyond);
  CHECK(extension.beyond > PathOfContact::extension);
  // 1e-12 base pitches of the root, times the slope of the gap: round-off.
  CHECK(gap_of_pinion_edge(pair, extension.beyond * pair.transverse_base_pitch) == Approx(0.03 * 2).epsilon(1e-9));
  CHECK(gap_of_pinion_edge(pair, PathOfContact::extension * pair.transverse_base_pitch) < 0.03 * 2);
  CHECK(PathOfContact(pair).beyond == extension.beyond);
  // Seen from the other gear the pair is the same.
  const EdgeExtension exchanged = edge_extension(mesh_cases::pair(z2, z1, helix, 2, 20));
  CHECK(exchanged.before == Approx(extension.beyond).epsilon(1e-10));
  CHECK(exchanged.beyond == Approx(extension.before).epsilon(1e-10));
}

TEST_CASE("With few teeth tip edges have left the mate within Haddad's extension", "[core][contact]") {
  const GearPair pair = GENERATE(mesh_cases::pair(18, 54, 30, 10, 120), mesh_cases::pair(25, 50, 0, 3, 30), mesh_cases::pair(23, 94, 12, 8, 230));
  CHECK(edge_extension(pair).before == PathOfContact::extension);
  CHECK(edge_extension(pair).beyond == PathOfContact::extension);
  CHECK(gap_of_pinion_edge(pair, PathOfContact::extension * pair.transverse_base_pitch) > 0.03 * pair.data.normal_module);
}
