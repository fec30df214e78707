#include "core/load/iso_load_factors.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/path_of_contact.hpp"
#include "core/load/load_factors.hpp"

namespace flankwright {

namespace {

/// Metal added at places of the plane of action on tooth pair k, transverse base tangent [mm]: places by roll length of the pinion
/// and z.
Eigen::VectorXd added(const GearPair& pair, const FlankCondition& condition, int tooth,
                      const std::vector<std::pair<double, double>>& places) {
  const PathOfContact path(pair);
  std::vector<ContactPoint> points;
  for (const auto& [roll, z] : places) {
    ContactPoint point;
    point.tooth = tooth;
    point.z = z;
    point.phase = (roll - path.roll_at_start) / path.base_pitch;
    point.pinion_radius = std::hypot(pair.pinion.base_radius, roll);
    point.wheel_radius = std::hypot(pair.wheel.base_radius, pair.path_length - roll);
    points.push_back(point);
  }
  return plane_of_action_gap(pair, points, condition).error / std::cos(pair.base_helix_angle);
}

/// Tooth pairs after which slopes repeat on this gear.
int most_teeth_told_apart(const ManufacturingError& error) {
  return static_cast<int>(std::max({std::size_t{1}, error.helix_slopes.size(), error.profile_slopes.size()}));
}

double largest_pitch_step(const ManufacturingError& error) {
  const std::vector<double>& list = error.cumulative_pitch;
  if (list.empty()) return std::abs(error.pitch_step);
  double largest = 0.0;
  for (std::size_t i = 0; i < list.size(); ++i) largest = std::max(largest, std::abs(list[(i + 1) % list.size()] - list[i]));
  return largest;
}

/// Peak to peak of the errors' profile deviation of both gears at mid face, tooth pair k.
double profile_deviation(const GearPair& pair, const FlankCondition& condition, int tooth) {
  constexpr int sections = 16;  // the errors' profiles are straight in the radius, curved a little in the roll length
  FlankCondition errors;
  errors.pinion_error.profile_slope = tooth_error(condition.pinion_error, tooth).profile_slope;
  errors.wheel_error.profile_slope = tooth_error(condition.wheel_error, tooth).profile_slope;
  std::vector<std::pair<double, double>> places;
  for (int i = 0; i <= sections; ++i) {
    places.emplace_back(pair.path_start + (pair.path_end - pair.path_start) * i / sections, 0.0);
  }
  const Eigen::VectorXd deviation = added(pair, errors, 0, places);
  return deviation.maxCoeff() - deviation.minCoeff();
}

}  // namespace

IsoDeviations iso_deviations(const GearPair& pair, const FlankCondition& condition) {
  const double half = 0.5 * pair.face_width, middle = condition.misalignment.axial_offset / 2.0;
  IsoDeviations deviations{0.0, std::max(largest_pitch_step(condition.pinion_error), largest_pitch_step(condition.wheel_error))};
  for (int tooth = 0; tooth < std::max(most_teeth_told_apart(condition.pinion_error), most_teeth_told_apart(condition.wheel_error)); ++tooth) {
    const Eigen::VectorXd ends =
        added(pair, lead_part(condition), tooth, {{pair.pitch_point, middle - half}, {pair.pitch_point, middle + half}});
    deviations.misalignment = std::max(deviations.misalignment, std::abs(ends[1] - ends[0]));
    deviations.base_pitch = std::max(deviations.base_pitch, profile_deviation(pair, condition, tooth));
  }
  return deviations;
}

IsoLoadFactors iso_load_factors(const GearPair& pair, const IsoStiffness& stiffness, const IsoDeviations& deviations,
                                double pinion_torque, double face_width) {
  IsoLoadFactors factors;
  factors.deviations = deviations;
  factors.specific_load = pinion_torque / pair.pinion.reference_radius / face_width;
  factors.running_in = std::min(0.075 * deviations.base_pitch, 3.0 * units::um);
  const double c = stiffness.c_gamma / units::um;  // N/mm^2

  const double q = deviations.misalignment * c / factors.specific_load;
  factors.lead = q <= 2.0 ? 1.0 + 0.5 * q : std::sqrt(2.0 * q);

  const double alpha = pair.transverse_contact_ratio, beta = std::min(1.0, pair.overlap_ratio);
  const double total = pair.total_contact_ratio();
  const double z_squared = (4.0 - alpha) * (1.0 - beta) / 3.0 + beta / alpha;
  factors.profile_limit = std::max(1.0, total / (alpha * z_squared));
  const double pitch = 0.4 * c * (deviations.base_pitch - factors.running_in) / (factors.specific_load * factors.lead);
  const double free = total <= 2.0 ? 0.5 * total * (0.9 + pitch) : 0.9 + std::sqrt(2.0 * (total - 1.0) / total) * pitch;
  factors.profile = std::clamp(free, 1.0, factors.profile_limit);
  return factors;
}

}  // namespace flankwright
