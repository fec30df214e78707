#include "core/rating/iso_load_factors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contact/gap/condition_gap.hpp"
#include "core/contact/path/path_of_contact.hpp"
#include "core/load/cycle/mesh_motion.hpp"
#include "core/rating/load_factors.hpp"

namespace flankwright {

namespace {

/// Points of the plane of action on tooth pair k by roll length of the pinion and z.
std::vector<ContactPoint> at_stations(const GearPair& pair, int tooth, const std::vector<std::pair<double, double>>& stations) {
  const PathOfContact path(pair);
  std::vector<ContactPoint> points;
  for (const auto& [roll, z] : stations) {
    ContactPoint point;
    point.tooth = tooth;
    point.z = z;
    point.phase = (roll - path.roll_at_start) / path.base_pitch;
    point.pinion_radius = std::hypot(pair.pinion.base_radius, roll);
    point.wheel_radius = std::hypot(pair.wheel.base_radius, pair.path_length - roll);
    points.push_back(point);
  }
  return points;
}

/// Metal added there, transverse base tangent [mm].
Eigen::VectorXd added(const GearPair& pair, const FlankCondition& condition, const std::vector<ContactPoint>& stations) {
  return plane_of_action_gap(pair, stations, condition).error / std::cos(pair.base_helix_angle);
}

/// Both ends of the common face, end roundings included.
std::vector<ContactPoint> face_ends(const GearPair& pair, const FlankCondition& condition, int tooth) {
  const double offset = condition.misalignment.axial_offset;  // of the wheel
  const double of_pinion = 0.5 * pair.pinion.data.face_width, of_wheel = 0.5 * pair.wheel.data.face_width;
  const double begin = std::max(-of_pinion, offset - of_wheel), end = std::min(of_pinion, offset + of_wheel);
  return at_stations(pair, tooth, {{pair.pitch_point, begin}, {pair.pitch_point, end}});
}

/// Takes what was measured out of a condition. @returns  a condition of it alone
FlankCondition take_measured(FlankCondition& condition) {
  FlankCondition measured;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    std::swap(measured.modification[m].topography, condition.modification[m].topography);
    std::swap(measured.error[m].topographies, condition.error[m].topographies);
  }
  return measured;
}

/// The rise of a line through values at equal distances, by least squares, from the first to the last.
double rise_of_line(const Eigen::VectorXd& values) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(values.size(), -0.5, 0.5);
  return x.dot(values) / x.squaredNorm();
}

/// Difference of the lead part between both ends, signed [mm]: less what opens the mesh at +z. Of a measured trace that of its mean line, as ISO 1328-1 has the
/// helix slope deviation.
double linear_part(const GearPair& pair, const FlankCondition& condition, int tooth) {
  FlankCondition lead = lead_part(condition);
  const FlankCondition measured = take_measured(lead);
  const std::vector<ContactPoint> ends = face_ends(pair, condition, tooth);
  const Eigen::VectorXd at_ends = added(pair, lead, ends);
  const double rise = at_ends[1] - at_ends[0];
  if (measured == FlankCondition{}) return rise;
  constexpr int sections = 33;
  std::vector<std::pair<double, double>> stations;
  for (int i = 0; i < sections; ++i) stations.emplace_back(pair.pitch_point, std::lerp(ends[0].z, ends[1].z, i / (sections - 1.0)));
  return rise + rise_of_line(added(pair, measured, at_stations(pair, tooth, stations)));
}

/// Tooth pairs after which slopes repeat on the gear with the longer list.
int teeth_told_apart(const FlankCondition& condition) {
  std::size_t most = 1;
  for (const ManufacturingError* error : {&condition.error.pinion, &condition.error.wheel}) {
    most = std::max({most, error->helix_slopes.size(), error->profile_slopes.size(), error->topographies.size()});
  }
  return static_cast<int>(most);
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
  constexpr int sections = 16;  // given slopes are straight in the radius, curved a little in the roll length
  const FlankCondition profile = profile_part(condition);
  FlankCondition errors;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    errors.error[m].profile_slope = tooth_error(condition.error[m], tooth).profile_slope;
    const auto& measured = profile.error[m].topographies;
    if (!measured.empty()) errors.error[m].topographies = {measured[static_cast<std::size_t>(tooth) % measured.size()]};
  }
  std::vector<std::pair<double, double>> stations;
  for (int i = 0; i <= sections; ++i) {
    stations.emplace_back(pair.path_start + (pair.path_end - pair.path_start) * i / sections, 0.0);
  }
  const Eigen::VectorXd deviation = added(pair, errors, at_stations(pair, 0, stations));
  return deviation.maxCoeff() - deviation.minCoeff();
}

/// dF_beta_y, by the tooth pair that counts.
Eigen::RowVectorXd misalignment_derivative(const MeshModel& model, const FlankCondition& condition, const std::vector<MeshParameter>& parameters,
                                           const ShaftMisalignment& shafts) {
  const GearPair& pair = model.pair;
  int worst = 0;
  double sign = 0.0, largest = 0.0;
  for (int tooth = 0; tooth < teeth_told_apart(condition); ++tooth) {
    const double step = linear_part(pair, condition, tooth) - shafts.value;
    if (std::abs(step) <= largest) continue;
    worst = tooth;
    largest = std::abs(step);
    sign = step < 0.0 ? -1.0 : 1.0;
  }
  const FlankCondition lead = lead_part(condition);
  const ConditionGap gaps(pair, GapModel::PlaneOfAction, lead);
  MeshPosition ends;
  ends.points = face_ends(pair, condition, worst);
  const Eigen::MatrixXd slopes = ConditionSlopes(model, gaps, parameters).at(ends, gaps.at(ends.points, 0.0)).gap;
  Eigen::RowVectorXd derivative = sign * (slopes.row(0) - slopes.row(1)) / std::cos(pair.base_helix_angle);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (!acts(parameters[p], lead_part)) derivative[static_cast<Eigen::Index>(p)] = 0.0;
  }
  for (const Eigen::Index p : moving_among(GapModel::PlaneOfAction, parameters)) {
    const auto parameter = std::get<MisalignmentParameter>(parameters[static_cast<std::size_t>(p)]);
    const PerturbedMeshes& perturbed = perturbed_meshes(model, parameter);
    const auto moved = [&](std::size_t k) { return linear_part(pair, placed_as(perturbed.meshes[k], parameter, condition), worst); };
    derivative[p] = sign * forward_difference(linear_part(pair, condition, worst), moved(0), moved(1), perturbed.step);
  }
  if (shafts.derivative.size() > 0) derivative -= sign * shafts.derivative;
  return derivative;
}

}  // namespace

IsoDeviations iso_deviations(const GearPair& pair, const FlankCondition& condition, double shaft_misalignment) {
  IsoDeviations deviations{0.0, std::max(largest_pitch_step(condition.error.pinion), largest_pitch_step(condition.error.wheel))};
  for (int tooth = 0; tooth < teeth_told_apart(condition); ++tooth) {
    deviations.misalignment = std::max(deviations.misalignment, std::abs(linear_part(pair, condition, tooth) - shaft_misalignment));
    deviations.base_pitch = std::max(deviations.base_pitch, profile_deviation(pair, condition, tooth));
  }
  return deviations;
}

IsoLoadFactors iso_load_factors(const GearPair& pair, const IsoStiffness& stiffness, const IsoDeviations& deviations, double pinion_torque,
                                double face_width) {
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

IsoGradient iso_gradient(const MeshModel& model, const FlankCondition& condition, const IsoLoadFactors& factors, const LoadedCycle& cycle,
                         const std::vector<MeshParameter>& parameters, const ShaftMisalignment& shafts) {
  IsoGradient gradient;
  gradient.misalignment = misalignment_derivative(model, condition, parameters, shafts);
  const Eigen::RowVectorXd load = cycle.force_derivative / cycle.force - cycle.face_width_change;  // relative
  gradient.specific_load = factors.specific_load * load;

  const double c = model.iso.c_gamma / units::um, q = factors.deviations.misalignment * c / factors.specific_load;
  const Eigen::RowVectorXd dq = gradient.misalignment * c / factors.specific_load - q * load;
  gradient.lead = (q <= 2.0 ? 0.5 : 1.0 / factors.lead) * dq;

  // K_Halpha is linear in f_pe/(s K_Hbeta), from `without`, its value for no deviation.
  const double total = model.pair.total_contact_ratio(), without = total <= 2.0 ? 0.45 * total : 0.9;
  const bool is_free = factors.profile > 1.0 && factors.profile < factors.profile_limit;
  gradient.profile = (is_free ? without - factors.profile : 0.0) * (load + gradient.lead / factors.lead);
  gradient.combined = gradient.lead * factors.profile + factors.lead * gradient.profile;
  return gradient;
}

}  // namespace flankwright
