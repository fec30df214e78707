#include "core/rating/sliding_loss.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

/// Sharp gears of a = 91.5 mm, with or without the tip alteration that keeps the tip clearance of the rack.
GearPair loss_pair(int z1, int z2, double module, double helix_deg, double x1, double x2, bool tip_alteration) {
  PairData data = mesh_cases::pair_data(z1, z2, helix_deg, module, 14);
  data.centre_distance = 91.5;
  const double cos_beta = std::cos(helix_deg * units::deg), unshifted = module * (z1 + z2) / (2.0 * cos_beta);
  const double k = tip_alteration ? (91.5 - unshifted) / module - (x1 + x2) : 0.0;
  data.pinion.profile_shift = x1;
  data.wheel.profile_shift = x2;
  data.pinion.tip_diameter = module * z1 / cos_beta + 2.0 * module * (1.0 + x1 + k);
  data.wheel.tip_diameter = module * z2 / cos_beta + 2.0 * module * (1.0 + x2 + k);
  return make_gear_pair(data);
}

/// Every pair in contact between A and E carries the same force, spread evenly over the face.
LoadedCycle evenly_shared(const MeshModel& model) {
  LoadedCycle cycle;
  cycle.force = 1000.0;
  for (const MeshPosition& at : model.positions) {
    LoadedPosition& position = cycle.positions.emplace_back();
    Eigen::VectorXd carries = Eigen::VectorXd::Zero(at.weight.size());
    for (Eigen::Index j = 0; j < carries.size(); ++j) {
      if (at.points[static_cast<std::size_t>(j)].clearance == 0.0) carries[j] = 1.0;
    }
    position.load.line_load = cycle.force / at.weight.dot(carries) * carries;
  }
  return cycle;
}

}  // namespace

TEST_CASE("Ohlendorf's loss factor has the published values of three test gears", "[core][rating][loss]") {
  // Four digits are printed. The spur pair comes out with tips as the rack and the profile shifts give them (with its tip alteration of -0.020 m_n it were
  // 0.1950), the helical pairs with the tip alteration (without it they were 0.1653 and 0.1243).
  constexpr double printed = 6e-5;
  CHECK(std::abs(ohlendorf_loss_factor(loss_pair(16, 24, 4.5, 0, 0.1817, 0.1715, false)) - 0.1986) < printed);
  CHECK(std::abs(ohlendorf_loss_factor(loss_pair(20, 30, 3.5, 15, 0.1809, 0.0891, true)) - 0.1639) < printed);
  CHECK(std::abs(ohlendorf_loss_factor(loss_pair(28, 42, 2.5, 15, 0.2290, 0.1489, true)) - 0.1225) < printed);
}

TEST_CASE("The local loss factor of evenly shared load is Ohlendorf's", "[core][rating][loss]") {
  const GearPair gears =
      GENERATE(loss_pair(16, 24, 4.5, 0, 0.1817, 0.1715, false), mesh_cases::pair(24, 36, 0, 4, 30), mesh_cases::pair(20, 80, 0, 3, 20));
  // Discretisation: pairs begin and end between positions, of which there are n a pitch; the error falls as 1/n.
  double error[2];
  int at = 0;
  for (const int n : {250, 1000}) {
    const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 2}, equally_spaced_phases(n)});
    error[at++] = std::abs(local_loss_factor(model, evenly_shared(model)).value / ohlendorf_loss_factor(gears) - 1.0);
  }
  CHECK(error[0] < 8e-3);
  CHECK(error[1] < 2e-3);
}

TEST_CASE("A line load at the pitch point slides nowhere, and sliding grows away from it", "[core][rating][loss]") {
  const GearPair gears = mesh_cases::pair(20, 40, 15, 4, 30);
  ContactPoint point;
  double last = -1.0;
  for (const double away : {0.0, 1.0, 3.0, 6.0}) {
    set_rolls(gears, gears.pitch_point + away, gears.path_length - gears.pitch_point - away, point);
    const double sliding = relative_sliding(gears, point);
    // v_g = (omega_1 + omega_2) g, v_tb = omega_1 r_b1
    CHECK(sliding == tests::about(away * (1.0 + 0.5) / gears.pinion.base_radius, 1e-12));
    CHECK(sliding > last);
    last = sliding;
  }
}

TEST_CASE("The loss factor of a loaded mesh has its derivatives", "[core][rating][loss]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = mesh_cases::model(gears, {{}, equally_spaced_phases(8)});
  const FlankCondition condition = mesh_cases::worked_condition();
  const double torque = mesh_cases::torque_for(gears, 200);
  const std::vector<MeshParameter> parameters{GearParameter{Member::Pinion, parameter_of("lead_crowning")},
                                              GearParameter{Member::Pinion, parameter_of("tip_relief.amount")},
                                              GearParameter{Member::Wheel, parameter_of("lead_slope")}, PinionTorque{}};
  const CycleNumber exact = local_loss_factor(model, analyse_cycle(model, condition, torque, parameters));
  const auto value = [&](const FlankCondition& at, double under) { return local_loss_factor(model, analyse_cycle(model, at, under)).value; };
  constexpr double discretisation = 1e-6;
  for (Eigen::Index p = 0; p + 1 < std::ssize(parameters); ++p) {
    const auto& parameter = std::get<GearParameter>(parameters[static_cast<std::size_t>(p)]);
    constexpr double step = 1e-7;
    const double difference =
        (value(mesh_cases::moved(condition, parameter, step), torque) - value(mesh_cases::moved(condition, parameter, -step), torque)) / (2.0 * step);
    CHECK(std::abs(exact.gradient[p] - difference) <= discretisation * std::abs(difference) + 1e-9 * exact.value / units::um);
  }
  const double step = 1e-5 * torque;
  const double difference = (value(condition, torque + step) - value(condition, torque - step)) / (2.0 * step);
  CHECK(std::abs(exact.gradient[3] - difference) <= 1e-5 * std::abs(difference) + 1e-9 * exact.value / torque);
}

TEST_CASE("Schlenk's friction has the exponents of its formula", "[core][rating][loss]") {
  const GearPair gears = loss_pair(16, 24, 4.5, 0, 0.1817, 0.1715, false);
  const Lubricant oil{.viscosity_40 = 100.0, .viscosity_100 = 11.0, .temperature = 90.0};
  const double speed = 1500 * 2.0 * units::pi / 60.0, force = 8000.0;
  const double mu = schlenk_friction(gears, 14.0, force, speed, oil, 90.0, 0.5);
  CHECK(mu > 0.03);  // of gears in oil
  CHECK(mu < 0.08);
  constexpr double round_off = 1e-12;
  CHECK(schlenk_friction(gears, 14.0, 2.0 * force, speed, oil, 90.0, 0.5) == Approx(mu * std::pow(2.0, 0.2)).epsilon(round_off));
  CHECK(schlenk_friction(gears, 14.0, force, 2.0 * speed, oil, 90.0, 0.5) == Approx(mu * std::pow(2.0, -0.2)).epsilon(round_off));
  CHECK(schlenk_friction(gears, 14.0, force, speed, oil, 90.0, 1.0) == Approx(mu * std::pow(2.0, 0.25)).epsilon(round_off));
  const double least = schlenk_friction(gears, 14.0, 150.0 * 14.0, speed, oil, 90.0, 0.5);
  CHECK(schlenk_friction(gears, 14.0, 10.0, speed, oil, 90.0, 0.5) == least);
  Lubricant other = oil;
  other.base = BaseOil::Polyalphaolefin;
  CHECK(schlenk_friction(gears, 14.0, force, speed, other, 90.0, 0.5) == Approx(0.8 * mu).epsilon(round_off));
}
