#include "core/contact/assembly/flank_assembly.hpp"

#include <cmath>
#include <string>

#include "core/gear/involute.hpp"

namespace flankwright {

namespace {

double sense_of_crossing(const GearPair& pair) { return pair.data.working_flank == WorkingFlank::Right ? 1.0 : -1.0; }

/// The wheel's tilt as one rotation vector [rad].
Eigen::Vector3d tilt(const GearPair& pair, const Misalignment& misalignment) {
  return {sense_of_crossing(pair) * misalignment.crossing, misalignment.intersecting, 0.0};
}

/// TM-107451, appendix 2 (A.2.1-A.2.8) with beta = pi/2 - lambda_p for the pinion as it was really made.
void apply_pinion_errors(const GearPair& pair, const Misalignment& misalignment, Flank& flank) {
  const double beta = pair.data.helix_angle - misalignment.pinion_lead_angle;
  const double alpha_n = pair.data.pressure_angle + misalignment.pinion_pressure_angle;
  if (!(std::abs(beta) < 0.5 * units::pi) || !(alpha_n > 0.0 && alpha_n < 0.5 * units::pi)) {
    throw InvalidInput("misalignment.pinion_lead_angle", std::to_string(misalignment.pinion_lead_angle),
                       "an error that leaves the helix and pressure angle between 0 and 90 deg");
  }
  const double cos_beta = std::cos(beta), tan_alpha = std::sin(alpha_n) / (std::cos(alpha_n) * cos_beta), alpha = std::atan(tan_alpha);
  const double pitch_radius = 0.5 * pair.data.normal_module * pair.data.pinion.teeth / cos_beta;
  // Polar angle of the flank at the pitch cylinder is what the tooth spacing fixes (mu_1 of A.1.1).
  const double polar_angle = involute(pair.working_transverse_pressure_angle) - involute(pair.transverse_pressure_angle);
  // A spur pinion with a lead error has a helix of the error's own hand: negative beta turns right-handed.
  const double sense = pair.contact_line_sense() == 0 ? 1.0 : pair.contact_line_sense();
  flank.base_radius = pitch_radius * std::cos(alpha);
  flank.origin = polar_angle + tan_alpha - alpha;
  flank.helix_rate = sense * std::sin(beta) / cos_beta / pitch_radius;
  flank.form_radius = std::max(flank.form_radius, flank.base_radius * lowest_start);
  if (!(flank.tip_radius > flank.form_radius)) {
    throw InvalidInput("misalignment.pinion_pressure_angle", std::to_string(misalignment.pinion_pressure_angle),
                       "an error that leaves the tip circle above the base circle");
  }
}

}  // namespace

FlankAssembly assemble_flanks(const GearPair& pair, const FlankCondition& condition) {
  const auto flank = [&](Member m) { return make_flank(pair, m, condition.modification[m], condition.error[m]); };
  const Misalignment& misalignment = condition.misalignment;
  FlankAssembly assembly;
  assembly.pinion = flank(Member::Pinion);
  assembly.wheel = flank(Member::Wheel);
  if (misalignment.pinion_lead_angle != 0.0 || misalignment.pinion_pressure_angle != 0.0) {
    apply_pinion_errors(pair, misalignment, assembly.pinion);
  }
  assembly.pinion_teeth = pair.data.pinion.teeth;
  assembly.wheel_teeth = pair.data.wheel.teeth;

  // F_beta_y is a deviation of the flank lines: it opens the mesh as removed metal on the wheel does.
  assembly.wheel.error.helix_slope -= misalignment.mesh_misalignment * assembly.wheel.frame.face_width / pair.face_width;

  const Eigen::Vector3d rotation = tilt(pair, misalignment);
  const double angle = rotation.norm();
  const Eigen::Matrix3d tilted = angle == 0.0 ? Eigen::Matrix3d::Identity() : Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
  assembly.wheel_axes = tilted * Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal();
  assembly.wheel_centre = {pair.centre_distance + misalignment.centre_distance, 0.0, misalignment.axial_offset};
  return assembly;
}

}  // namespace flankwright
