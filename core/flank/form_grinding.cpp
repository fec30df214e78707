#include "core/flank/form_grinding.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/gear/involute.hpp"

namespace flankwright {

FormWheelContact::FormWheelContact(const GearPair& pair, Member member, double wheel_diameter)
    : base_radius_(pair[member].base_radius),
      helix_rate_(pair.flank_frame(member).helix_rate),
      tan_swivel_(helix_rate_ * pair[member].reference_radius),
      tan_base_helix_(helix_rate_ * base_radius_),
      axis_distance_(0.5 * wheel_diameter + pair[member].root_radius),
      wheel_diameter_(wheel_diameter) {
  const Gear& gear = pair[member];
  const double depth = gear.tip_radius - gear.root_radius;
  if (!(0.5 * wheel_diameter > depth)) {
    throw InvalidInput("grinding_wheel_diameter", in_words(wheel_diameter) + " mm",
                       "above " + in_words(2.0 * depth) + " mm, twice the depth of a tooth: the wheel turns outside the tip circle");
  }
  const double half_space = units::pi / gear.data.teeth - 0.5 * gear.tooth_thickness / gear.reference_radius;
  start_ = involute(pair.transverse_pressure_angle) - half_space;
}

double FormWheelContact::position(double rho, double near) const {
  constexpr int most_steps = 50;
  double z = near;
  for (int i = 0; i < most_steps; ++i) {
    const double delta = start_ + helix_rate_ * z - rho / base_radius_, s = std::sin(delta), c = std::cos(delta);
    const double miss = -z * s + tan_swivel_ * (axis_distance_ * c - base_radius_) + tan_base_helix_ * (base_radius_ * c - rho * s - axis_distance_);
    const double rate = -s - helix_rate_ * (z * c + tan_swivel_ * axis_distance_ * s + tan_base_helix_ * (base_radius_ * s + rho * c));
    if (!(rate > 0.0)) break;  // the wheel touches along two lines here, or none
    const double step = miss / rate;
    z -= step;
    if (std::abs(step) <= 1e-8 * axis_distance_) return z;  // Newton: the next step is the square of this
  }
  throw InvalidInput("grinding_wheel_diameter", in_words(wheel_diameter_) + " mm",
                     "a wheel that touches the flank in one point of each radius between form and tip circle");
}

}  // namespace flankwright
