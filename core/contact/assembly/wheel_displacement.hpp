#pragma once

#include <cmath>

#include "core/contact/path/contact_points.hpp"
#include "core/contact/assembly/misalignment.hpp"
#include "core/contact/path/path_of_contact.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Displacement of a misaligned wheel away from the pinion along its outward normal n = (cos b_b L, -s sin b_b), L =
/// (sin a, cos a, 0), and along the profile t = (-cos a, sin a, 0), first order in the angles: linear in every part of a misalignment except the
/// axial offset, which shifts the levers too. The errors of the pinion take no part.
class WheelDisplacement {
 public:
  WheelDisplacement(const GearPair& pair, const Misalignment& m) : WheelDisplacement(pair, m, m.axial_offset) {}
  /// @param axial_offset  of the wheel's mid face, the centre of its rotations [mm]
  WheelDisplacement(const GearPair& pair, const Misalignment& m, double axial_offset)
      : pair_(pair),
        path_(pair),
        misalignment_(m),
        centre_(axial_offset),
        sin_alpha_(std::sin(pair.working_transverse_pressure_angle)),
        cos_alpha_(std::cos(pair.working_transverse_pressure_angle)),
        sin_beta_(std::sin(pair.base_helix_angle)),
        cos_beta_(std::cos(pair.base_helix_angle)) {
    const double mirror = pair.data.working_flank == WorkingFlank::Right ? 1.0 : -1.0;
    about_x_ = mirror * m.crossing;
    about_y_ = m.intersecting;
  }

  /// Away from the pinion at a contact point [mm].
  double along_normal(const ContactPoint& point) const {
    // Contact point relative to the wheel's centre: pitch point plus its distance s along the line of action.
    const double s = path_.roll_at(point.phase) - pair_.pitch_point;
    const double x = -pair_.wheel.working_pitch_radius + s * sin_alpha_, y = s * cos_alpha_;
    const double dz = about_x_ * y - about_y_ * x + misalignment_.axial_offset;
    const double opened = misalignment_.mesh_misalignment * (point.z - centre_) / pair_.face_width;
    return cos_beta_ * (along_action(point.z) + opened) - pair_.contact_line_sense() * sin_beta_ * dz;
  }

  /// Along the line of action in a transverse section [mm].
  double along_action(double z) const {
    const Transverse d = in_section(z);
    return d.x * sin_alpha_ + d.y * cos_alpha_;
  }

  /// Along the flanks in a transverse section, towards the wheel's tip [mm]. This displacement is without first-order influence on the gap.
  double along_profile(double z) const {
    const Transverse d = in_section(z);
    return d.y * sin_alpha_ - d.x * cos_alpha_;
  }

 private:
  struct Transverse {
    double x, y;
  };
  Transverse in_section(double z) const { return {about_y_ * (z - centre_) + misalignment_.centre_distance, -about_x_ * (z - centre_)}; }

  const GearPair& pair_;
  PathOfContact path_;
  Misalignment misalignment_;
  double centre_, sin_alpha_, cos_alpha_, sin_beta_, cos_beta_, about_x_, about_y_;
};

}  // namespace flankwright
