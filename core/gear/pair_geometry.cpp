#include "core/gear/pair_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "core/gear/involute.hpp"

namespace flankwright {

double Gear::pressure_angle_at(double radius) const { return std::acos(std::min(1.0, base_radius / radius)); }

double Gear::roll_length_at(double radius) const { return std::sqrt(std::max(0.0, (radius - base_radius) * (radius + base_radius))); }

double Gear::tooth_thickness_at(double radius) const {
  const double alpha_t = pressure_angle_at(reference_radius);
  return 2.0 * radius * (0.5 * tooth_thickness / reference_radius + involute(alpha_t) - involute(pressure_angle_at(radius)));
}

double GearPair::backlash_at(double distance) const {
  const double per_tooth = distance / (data.pinion.teeth + data.wheel.teeth);  // half the module of the pitch circles
  return 2.0 * units::pi * per_tooth - pinion.tooth_thickness_at(data.pinion.teeth * per_tooth) -
         wheel.tooth_thickness_at(data.wheel.teeth * per_tooth);
}

GearPair GearPair::on_other_flanks() const {
  GearPair other = *this;
  other.data.working_flank = opposite(data.working_flank);
  for (Gear* gear : {&other.pinion, &other.wheel}) gear->face = {-gear->face.end, -gear->face.begin};  // broken edges take more at the acute end
  return other;
}

int GearPair::contact_line_sense() const {
  if (data.helix_angle == 0.0) return 0;
  const int hand = data.pinion_hand == Hand::Right ? 1 : -1;
  return data.working_flank == WorkingFlank::Right ? hand : -hand;
}

FlankFrame GearPair::flank_frame(Member m) const {
  const Gear& gear = (*this)[m];
  const bool is_pinion = m == Member::Pinion;
  FlankFrame frame;
  frame.pitch_radius = gear.working_pitch_radius;
  frame.reference_radius = gear.reference_radius;
  frame.tip_radius = gear.tip_form_radius;
  frame.active_root_radius = gear.active_root_radius;
  frame.face_width = gear.data.face_width;
  frame.base_radius = gear.base_radius;
  frame.pitch_roll = gear.roll_length_at(gear.working_pitch_radius);
  frame.helix_rate = contact_line_sense() * (is_pinion ? 1.0 : -1.0) * gear.helix_rate;
  frame.pinion_turn = is_pinion ? 1.0 : -gear_ratio();
  frame.wheel_base_radius = wheel.base_radius;
  return frame;
}

}  // namespace flankwright
