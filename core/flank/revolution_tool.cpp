#include "core/flank/revolution_tool.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace flankwright {

namespace {

/// The parabola is strength / (rho + relative_radius).
struct ArcLaw {
  double strength;         ///< tan^2(alpha) r_b1^2 / (2 r_b2) [mm]
  double relative_radius;  ///< rho_rel [mm]

  ArcLaw(const GearPair& pair, Member member) {
    if (pair.data.helix_angle != 0.0) {
      throw InvalidInput("pair.helix_angle", std::to_string(pair.data.helix_angle / units::deg), "0 deg (spur gears)");
    }
    const Gear& gear = pair[member];
    const double own = gear.roll_length_at(gear.reference_radius);
    const double tangent = own / gear.base_radius, r1 = pair.pinion.base_radius;
    strength = 0.5 * tangent * tangent * r1 * r1 / pair.wheel.base_radius;
    relative_radius = own * (pair.path_length - own) / pair.path_length;
  }
};

}  // namespace

double parabola_of_arc(const GearPair& pair, Member member, double arc_radius) {
  const ArcLaw law(pair, member);
  if (!(arc_radius > 0.0)) throw InvalidInput("arc_radius", std::to_string(arc_radius), "above 0 mm");
  return law.strength / (arc_radius + law.relative_radius);
}

double arc_for_parabola(const GearPair& pair, Member member, double coefficient) {
  const ArcLaw law(pair, member);
  const double largest = law.strength / law.relative_radius;
  if (!(coefficient >= 0.0 && coefficient < largest)) {
    throw InvalidInput("coefficient", std::to_string(coefficient), std::string("0 or more and below ").append(std::to_string(largest)));
  }
  return coefficient == 0.0 ? std::numeric_limits<double>::infinity() : law.strength / coefficient - law.relative_radius;
}

}  // namespace flankwright
