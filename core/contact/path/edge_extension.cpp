#include "core/contact/path/edge_extension.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/root.hpp"

namespace flankwright {

namespace {

constexpr double largest_deflection = 0.03;  ///< [m_n]
constexpr double accuracy = 1e-12;           ///< of the extension [base pitches]

double involute(double pressure_angle) { return std::tan(pressure_angle) - pressure_angle; }

double extension_of(const Gear& gear, const Gear& mate, const GearPair& pair) {
  const double a = pair.centre_distance, tip = gear.tip_form_radius, pitch = pair.transverse_base_pitch;
  const double at_end = gear.pressure_angle_at(tip) - pair.working_transverse_pressure_angle;
  const auto turned = [&](double extension) { return at_end + extension * pitch / gear.base_radius; };
  const auto from_mate = [&](double psi) { return std::sqrt((a - tip) * (a - tip) + 2.0 * a * tip * (1.0 - std::cos(psi))); };
  const auto seen_by_mate = [&](double psi) { return std::atan2(tip * std::sin(psi), a - tip * std::cos(psi)); };
  const auto involute_at = [&](double psi) { return involute(mate.pressure_angle_at(std::max(from_mate(psi), mate.base_radius))); };
  const auto beyond_deflection = [&](double extension) {
    const double psi = turned(extension);
    const double gap = mate.base_radius * (seen_by_mate(at_end) + involute_at(psi) - involute_at(at_end) - seen_by_mate(psi)) + extension * pitch;
    return gap - largest_deflection * pair.data.normal_module;
  };
  constexpr double least = EdgeExtension::least;
  const double near = beyond_deflection(least);
  if (near >= 0.0) return least;
  const double mate_tip = mate.tip_form_radius, cosine = (a * a + tip * tip - mate_tip * mate_tip) / (2.0 * a * tip);
  const double last = std::abs(cosine) < 1.0 ? (std::acos(cosine) - at_end) * gear.base_radius / pitch : 0.0;
  if (last <= least) return least;
  const double far = beyond_deflection(last);
  return far > 0.0 ? bracketed_root(beyond_deflection, least, near, last, far, accuracy).x : last;
}

}  // namespace

EdgeExtension edge_extension(const GearPair& pair) {
  return {extension_of(pair.wheel, pair.pinion, pair), extension_of(pair.pinion, pair.wheel, pair)};
}

}  // namespace flankwright
