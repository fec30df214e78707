#include "core/flank/revolution_tool.hpp"

#include <string>

namespace flankwright {

double parabola_of_arc(const GearPair& pair, Member member, double arc_radius) {
  if (pair.data.helix_angle != 0.0) {
    throw InvalidInput("pair.helix_angle", std::to_string(pair.data.helix_angle / units::deg), "0 deg (spur gears)");
  }
  if (!(arc_radius > 0.0)) throw InvalidInput("arc_radius", std::to_string(arc_radius), "above 0 mm");
  const Gear& gear = pair[member];
  const double own = gear.roll_length_at(gear.reference_radius);
  const double tangent = own / gear.base_radius, r1 = pair.pinion.base_radius;
  const double strength = 0.5 * tangent * tangent * r1 * r1 / pair.wheel.base_radius;
  const double relative_radius = own * (pair.path_length - own) / pair.path_length;
  return strength / (arc_radius + relative_radius);
}

}  // namespace flankwright
