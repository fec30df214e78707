#include "core/flank/involute_flank.hpp"

#include "core/gear/involute.hpp"

namespace flankwright {

InvoluteFlank make_flank(const GearPair& pair, Member member, const Modification& modification,
                         const ManufacturingError& error) {
  const Gear& gear = pair[member];
  InvoluteFlank flank;
  flank.base_radius = gear.base_radius;
  flank.helix_rate = pair.contact_line_sense() * (member == Member::Pinion ? 1 : -1) * gear.helix_rate;
  flank.origin = involute(pair.working_transverse_pressure_angle);
  flank.form_radius = std::max(gear.form_radius, gear.base_radius * lowest_start);
  flank.tip_radius = gear.tip_radius;
  flank.half_face = 0.5 * gear.data.face_width;
  flank.frame = pair.flank_frame(member);
  flank.modification = modification;
  flank.error = error;
  return flank;
}

}  // namespace flankwright
