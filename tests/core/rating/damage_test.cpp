#include "core/rating/damage.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <tuple>

#include "tests/core/load/mesh_cases.hpp"
#include "tests/core/load/synthetic_root_stress.hpp"

using namespace flankwright;

namespace {

struct DamagedPair {
  GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  mesh_cases::SyntheticRootStress root_stress{gears};
  MeshModel model =
      make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, {{}, equally_spaced_phases(6)}, {}, {}, {.root_stress = &root_stress});

  LoadedCycle under(double line_load) const { return analyse_cycle(model, mesh_cases::worked_condition(), mesh_cases::torque_for(gears, line_load)); }
};

}  // namespace

TEST_CASE("Damage of a spectrum of two loads is Miner's sum by hand", "[core][rating][life]") {
  const DamagedPair pair;
  const LoadedCycle heavy = pair.under(300), light = pair.under(120);
  const double limit = 0.7 * summarise(pair.model, heavy).peak_contact_stress;  // loads on either side of the knee
  const SnCurve curve{.limit = limit, .knee = 5e7, .exponent = 13.0, .exponent_beyond = 25.0};
  const LoadSpectrum spectrum{{&heavy, 2e5}, {&light, 3e7}};
  int above = 0, below = 0;
  for (std::size_t i = 0; i < pair.model.positions.size(); ++i) {
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      const Eigen::VectorXd damage = contact_damage(pair.model, spectrum, m, curve, i);
      REQUIRE(damage.size() == heavy.positions[i].contact_stress.size());
      const double turns = m == Member::Pinion ? 1.0 : 18.0 / 54.0;
      for (Eigen::Index j = 0; j < damage.size(); ++j) {
        double sum = 0.0;
        for (const auto& [stress, cycles] :
             {std::pair{heavy.positions[i].contact_stress[j], 2e5}, std::pair{light.positions[i].contact_stress[j], 3e7}}) {
          (stress > limit ? above : below) += 1;
          if (stress > 0.0) sum += turns * cycles / (5e7 * std::pow(limit / stress, stress > limit ? 13.0 : 25.0));
        }
        CHECK(damage[j] == Approx(sum).epsilon(1e-12).margin(1e-300));  // round-off
        CHECK(contact_damage_at(pair.model, spectrum, m, curve, i, j).value == damage[j]);
      }
    }
  }
  CHECK(above > 0);
  CHECK(below > 0);
}

TEST_CASE("Twice the hours do twice the damage, and a wheel of three times the teeth has a third of it", "[core][rating][life]") {
  const DamagedPair pair;
  const LoadedCycle cycle = pair.under(200);
  const SnCurve curve = contact_sn_curve(LifeFactors::CaseHardened, 900.0);
  const Eigen::VectorXd once = contact_damage(pair.model, {{&cycle, 1e6}}, Member::Pinion, curve, 2);
  const Eigen::VectorXd twice = contact_damage(pair.model, {{&cycle, 2e6}}, Member::Pinion, curve, 2);
  const Eigen::VectorXd halves = contact_damage(pair.model, {{&cycle, 1e6}, {&cycle, 1e6}}, Member::Pinion, curve, 2);
  const Eigen::VectorXd wheel = contact_damage(pair.model, {{&cycle, 1e6}}, Member::Wheel, curve, 2);
  CHECK(once.maxCoeff() > 0.0);
  CHECK(twice == 2.0 * once);
  CHECK(halves == twice);
  CHECK((3.0 * wheel - once).cwiseAbs().maxCoeff() <= 1e-15 * once.maxCoeff());
}

TEST_CASE("Root damage takes the largest stress of each fillet point over the passage of a tooth", "[core][rating][life]") {
  const DamagedPair pair;
  const LoadedCycle heavy = pair.under(300), light = pair.under(120);
  const SnCurve curve = root_sn_curve(LifeFactors::CaseHardened, 60.0);
  const LoadSpectrum spectrum{{&heavy, 1e4}, {&light, 1e7}};
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    // By the stations' own places, without their order.
    std::map<std::pair<double, double>, std::pair<double, double>> largest;
    for (std::size_t i = 0; i < pair.model.positions.size(); ++i) {
      const auto& stations = pair.model.positions[i].root_stress.stations;
      for (std::size_t p = 0; p < stations.size(); ++p) {
        if (stations[p].member != m) continue;
        auto& [of_heavy, of_light] = largest[{stations[p].along, stations[p].z}];
        of_heavy = std::max(of_heavy, heavy.positions[i].root_stress[static_cast<Eigen::Index>(p)]);
        of_light = std::max(of_light, light.positions[i].root_stress[static_cast<Eigen::Index>(p)]);
      }
    }
    const double turns = m == Member::Pinion ? 1.0 : 1.0 / 3.0;
    double worst = 0.0;
    for (const auto& [place, stress] : largest) {
      worst = std::max(worst, turns * (1e4 / curve.cycles_to_failure(stress.first) + 1e7 / curve.cycles_to_failure(stress.second)));
    }
    const FilletPoints points = fillet_points(pair.model, m);
    CHECK(static_cast<std::size_t>(points.count) == largest.size());
    const Eigen::VectorXd damage = root_damage(pair.model, spectrum, m, curve, points);
    CHECK(damage.maxCoeff() == Approx(worst).epsilon(1e-12));  // round-off
    CHECK(worst > 0.0);
  }
}

TEST_CASE("Root damage without root stress is refused", "[core][rating][life]") {
  const DamagedPair pair;
  const LoadedCycle cycle = analyse_cycle(pair.model, {}, mesh_cases::torque_for(pair.gears, 100), {}, RootStresses::Later);
  const SnCurve curve = root_sn_curve(LifeFactors::CaseHardened, 500.0);
  CHECK_THROWS_AS(root_damage(pair.model, {{&cycle, 1.0}}, Member::Pinion, curve, fillet_points(pair.model, Member::Pinion)), std::runtime_error);
}
