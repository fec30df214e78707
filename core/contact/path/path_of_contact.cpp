#include "core/contact/path/path_of_contact.hpp"

#include "core/contact/path/edge_reach.hpp"

namespace flankwright {

PathOfContact::PathOfContact(const GearPair& pair)
    : base_pitch(pair.transverse_base_pitch),
      edges(edge_extension(pair)),
      before(edges.before + edge_reach(pair).before),
      beyond(edges.beyond + edge_reach(pair).beyond),
      roll_at_start(pair.path_start - before * base_pitch),
      region_length(before + pair.transverse_contact_ratio + beyond),
      slope(pair.contact_line_sense() * std::tan(pair.base_helix_angle) / base_pitch),
      half_face(0.5 * pair.face_width) {}

double PathOfContact::line_phase_at(double phi1, const GearPair& pair) const {
  const double at_mid_face = (pair.pitch_point + pair.pinion.base_radius * phi1 - roll_at_start) / base_pitch;
  return at_mid_face + std::abs(slope) * half_face;
}

double PathOfContact::pinion_angle_at(double line_phase, const GearPair& pair) const {
  const double at_mid_face = line_phase - std::abs(slope) * half_face;
  return (roll_at_start + at_mid_face * base_pitch - pair.pitch_point) / pair.pinion.base_radius;
}

}  // namespace flankwright
