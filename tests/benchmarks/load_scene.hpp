#pragma once

#include <cmath>
#include <vector>

#include "core/load/cycle/mesh_cycle.hpp"
#include "tests/core/load/synthetic_root_stress.hpp"
#include "tests/reference/haddad_18_54.hpp"
#include "core/gear/gear_pair.hpp"

/// The loaded mesh whose speed is measured, with influence matrices that cost nothing to make.
namespace flankwright::load_scene {

/// Every point coupled to every other one, as finite elements have it: half of each slice's own yield spreads along its tooth, a
/// part of that reaches the neighbours, and the bodies move as a whole. Sums of positive-definite kernels.
class CoupledSlices final : public PairCompliance {
 public:
  explicit CoupledSlices(const GearPair& pair) : reach_(2 * pair.data.normal_module), slices_(ThinSlice(pair, Material{}, Material{})) {}

  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const override {
    Eigen::MatrixXd K = slices_.influence(points, axial_offset);
    const Eigen::VectorXd own = (0.5 * K.diagonal()).cwiseSqrt();
    K.diagonal() *= 0.5;
    for (Eigen::Index i = 0; i < own.size(); ++i) {
      for (Eigen::Index j = 0; j < own.size(); ++j) {
        const ContactPoint &p = points[static_cast<std::size_t>(i)], &q = points[static_cast<std::size_t>(j)];
        const double tooth = p.tooth == q.tooth ? 1.0 : 0.3;
        K(i, j) += own[i] * own[j] * (tooth * std::exp(-std::abs(p.z - q.z) / reach_) + 0.05);
      }
    }
    return K;
  }

 private:
  double reach_;
  ThinSlicePair slices_;
};

/// Haddad's 18/54 pair, all points coupled, every effect of the loaded mesh on.
inline MeshModel model(int positions, int intervals, bool root_stress) {
  const GearPair pair = make_gear_pair(reference::haddad_18_54::pair_data());
  const CoupledSlices structure(pair);
  const mesh_cases::SyntheticRootStress fillets(pair);
  return make_mesh_model(pair, {}, {{QuadratureRule::Gauss2, intervals}, equally_spaced_phases(positions)}, {}, {},
                         {.structure = &structure, .root_stress = root_stress ? &fillets : nullptr});
}

inline constexpr double torque = 1014.868e3;  // N mm

/// Modified on both gears, misaligned, and not perfectly made.
inline FlankCondition condition() {
  FlankCondition condition;
  Modification& pinion = condition.modification.pinion;
  pinion.lead_crowning = 0.0077;
  pinion.lead_slope = 0.0005;
  pinion.addendum_crowning = pinion.dedendum_crowning = 0.0024;
  pinion.tip_relief = {0.008, 2.5, ReliefShape::Linear};
  pinion.twist = 0.002;
  condition.modification.wheel.tip_relief = {0.006, 2.5, ReliefShape::Parabolic};
  condition.modification.wheel.end_relief = {0.004, 10.0};
  condition.error.pinion.helix_slope = 0.002;
  condition.error.wheel.pitch_step = 0.001;
  condition.misalignment.mesh_misalignment = 0.008;
  condition.misalignment.crossing = 0.2 * units::arcmin;
  return condition;
}

inline std::vector<MeshParameter> eight_modifications() {
  const auto pinion = Member::Pinion, wheel = Member::Wheel;
  return {GearParameter{pinion, parameter_of("lead_crowning")},     GearParameter{pinion, parameter_of("lead_slope")},
          GearParameter{pinion, parameter_of("profile_crowning")},  GearParameter{pinion, parameter_of("tip_relief.amount")},
          GearParameter{pinion, parameter_of("tip_relief.height")}, GearParameter{pinion, parameter_of("twist")},
          GearParameter{wheel, parameter_of("tip_relief.amount")},  GearParameter{wheel, parameter_of("end_relief.amount")}};
}

}  // namespace flankwright::load_scene
