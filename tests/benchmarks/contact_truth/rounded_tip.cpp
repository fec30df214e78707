#include "tests/benchmarks/contact_truth/rounded_tip.hpp"

#include <cmath>

namespace flankwright::contact_truth {

RoundedTip::RoundedTip(const Gear& gear, double helix_rate)
    : rounding_(gear.data.tip_rounding), centre_(gear.tip_radius - gear.data.tip_rounding), helix_rate_(helix_rate) {
  const double cos_base_helix = std::cos(std::atan(helix_rate * gear.base_radius));
  flank_end_ = gear.roll_length_at(centre_) + rounding_ * cos_base_helix;
  angle_ = std::acos(cos_base_helix * std::sin(gear.pressure_angle_at(centre_)));
}

RoundedTip::Polar RoundedTip::at(double normal) const {
  const Polar p = about_centre(normal);
  return {p.radius, p.angle - about_centre(angle_).angle};
}

/// The ball's point in the plane across its centre's helix, brought back to z = 0 along the helix.
RoundedTip::Polar RoundedTip::about_centre(double normal) const {
  const double lead = centre_ * helix_rate_, across = rounding_ * std::sin(normal) / std::sqrt(1 + lead * lead);
  const double x = centre_ + rounding_ * std::cos(normal), y = across, z = -across * lead;
  return {std::hypot(x, y), std::atan2(y, x) - helix_rate_ * z};
}

}  // namespace flankwright::contact_truth
