#include "core/rating/sliding_loss.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

double ohlendorf_loss_factor(const GearPair& pair) {
  const double u = pair.gear_ratio();
  const double eps_1 = (pair.path_end - pair.pitch_point) / pair.transverse_base_pitch;
  const double eps_2 = (pair.pitch_point - pair.path_start) / pair.transverse_base_pitch;
  return units::pi * (u + 1.0) / (pair.data.pinion.teeth * u * std::cos(pair.base_helix_angle)) *
         (1.0 - eps_1 - eps_2 + eps_1 * eps_1 + eps_2 * eps_2);
}

double relative_sliding(const GearPair& pair, const ContactPoint& point) {
  const double rho_1 = pair.pinion.roll_length_at(point.pinion_radius), rho_2 = pair.wheel.roll_length_at(point.wheel_radius);
  return std::abs(rho_1 - rho_2 / pair.gear_ratio()) / pair.pinion.base_radius;
}

namespace {

/// a |v_g| / v_tb of the points of a position [mm].
Eigen::VectorXd weighted_sliding(const MeshModel& model, const MeshPosition& at) {
  Eigen::VectorXd sliding(std::ssize(at.points));
  for (std::size_t j = 0; j < at.points.size(); ++j) {
    sliding[static_cast<Eigen::Index>(j)] = at.weight[static_cast<Eigen::Index>(j)] * relative_sliding(model.pair, at.points[j]);
  }
  return sliding;
}

}  // namespace

CycleNumber local_loss_factor(const MeshModel& model, const LoadedCycle& cycle) {
  const double count = static_cast<double>(cycle.positions.size()), cos_beta_b = std::cos(model.pair.base_helix_angle);
  const double per_force = 1.0 / (count * cycle.force * cos_beta_b);
  CycleNumber factor{0.0, {}};
  const bool has_slopes = cycle.positions.front().line_load_derivative.cols() > 0;
  if (has_slopes) factor.gradient = Eigen::RowVectorXd::Zero(cycle.positions.front().line_load_derivative.cols());
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const Eigen::VectorXd sliding = weighted_sliding(model, model.positions[i]);
    const LoadedPosition& position = cycle.positions[i];
    factor.value += per_force * sliding.dot(position.load.line_load);
    if (has_slopes) factor.gradient += per_force * sliding.transpose() * position.line_load_derivative;
  }
  if (has_slopes) factor.gradient -= factor.value / cycle.force * cycle.force_derivative;
  return factor;
}

std::vector<double> local_loss_factors(const MeshModel& model, const LoadedCycle& cycle) {
  const double base_force = cycle.force * std::cos(model.pair.base_helix_angle);
  std::vector<double> factors;
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    factors.push_back(weighted_sliding(model, model.positions[i]).dot(cycle.positions[i].load.line_load) / base_force);
  }
  return factors;
}

double pitch_point_radius(const GearPair& pair) {
  return pair.pitch_point * (pair.path_length - pair.pitch_point) / pair.path_length / std::cos(pair.base_helix_angle);
}

double schlenk_friction(const GearPair& pair, double face_width, double force, double speed, const Lubricant& lubricant, double temperature_C,
                        double roughness) {
  constexpr double metre = 1e3;                // in mm
  constexpr double least_specific_load = 150;  // F_bt/b [N/mm]
  const double specific_load = std::max(least_specific_load, force * std::cos(pair.base_helix_angle) / face_width);
  const double v_sum = 2.0 * speed * pair.pitch_point / metre;  // both flanks have the same speed at C
  const double eta = 1e3 * lubricant.dynamic_viscosity(temperature_C).value;
  double X_L = 1.0;
  if (lubricant.base == BaseOil::Polyalphaolefin) X_L = 0.8;
  if (lubricant.base == BaseOil::Polyglycol) X_L = 0.75 * std::pow(6.0 / v_sum, 0.2);
  return 0.048 * std::pow(specific_load / (v_sum * pitch_point_radius(pair)), 0.2) * std::pow(eta, -0.05) * std::pow(roughness, 0.25) * X_L;
}

}  // namespace flankwright
