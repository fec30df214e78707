#include "core/load/cycle/mesh_cycle.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "core/compliance/local/hertz_line.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using mesh_cases::torque_for;
using mesh_cases::worked_condition;

namespace {

struct NamedPair {
  const char* name;
  PairData data;
};

/// Haddad's helical pair, a spur pair, a narrow pair of few slender teeth and a wide double of the second.
NamedPair named_pair(int i) {
  switch (i) {
    case 0:
      return {"helical 18/54", mesh_cases::pair_data(18, 54, 30, 10, 120)};
    case 1:
      return {"spur 20/40", mesh_cases::pair_data(20, 40, 0, 4, 30)};
    case 2:
      return {"narrow 25/31, helical", mesh_cases::pair_data(25, 31, 12, 2, 3)};
    default:
      return {"wide 30/90, helical", mesh_cases::pair_data(30, 90, 20, 3, 200)};
  }
}

int loaded_teeth(const MeshPosition& at, const LoadedPosition& loaded) {
  std::set<int> teeth;
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    if (loaded.load.line_load[static_cast<Eigen::Index>(i)] > 0.0) teeth.insert(at.points[i].tooth);
  }
  return static_cast<int>(teeth.size());
}

double tooth_force(const MeshPosition& at, const LoadedPosition& loaded, int tooth) {
  double force = 0.0;
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (at.points[i].tooth == tooth) force += at.weight[k] * loaded.load.line_load[k];
  }
  return force;
}

}  // namespace

TEST_CASE("At every mesh position of every pair the loads add up to the force", "[core][load]") {
  constexpr double kRoundOff = 1e-13;
  const NamedPair named = named_pair(GENERATE(0, 1, 2, 3));
  CAPTURE(named.name);
  const GearPair gears = make_gear_pair(named.data);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Gauss2, 8}, equally_spaced_phases(16)});
  const double torque = torque_for(gears, GENERATE(1.0, 300.0));
  const LoadedCycle cycle = analyse_cycle(model, worked_condition(), torque);
  REQUIRE(cycle.usable());
  CHECK(cycle.force == Approx(torque / (gears.pinion.base_radius * std::cos(gears.base_helix_angle))).epsilon(kRoundOff));
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const LoadedPosition& at = cycle.positions[i];
    CHECK(model.positions[i].weight.dot(at.load.line_load) == Approx(cycle.force).epsilon(kRoundOff));
    CHECK(at.load.line_load.minCoeff() >= 0.0);
    CHECK(at.load.kkt_residual <= 1e-12);
    // f_t = contact + structural deflection + gap, where loaded.
    for (Eigen::Index k = 0; k < at.load.line_load.size(); ++k) {
      if (at.load.line_load[k] == 0.0) continue;
      CHECK(at.load.contact_deflection[k] + at.load.structural_deflection[k] + at.gap.total[k] == Approx(at.load.transmission_error).epsilon(1e-11));
    }
  }
}

TEST_CASE("Contact stress is Hertz's for the load and radius of every point", "[core][load][closed-form]") {
  constexpr double kRoundOff = 1e-13;
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = mesh_cases::model(gears, {{}, {0.3, 0.8}});
  const LoadedCycle cycle = analyse_cycle(model, worked_condition(), torque_for(gears, 200.0));
  REQUIRE(cycle.usable());
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& points = model.positions[i].points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double w = cycle.positions[i].load.line_load[static_cast<Eigen::Index>(k)];
      if (cycle.positions[i].peak_load[static_cast<Eigen::Index>(k)] > w) continue;  // on a crest beside the point
      // p_0 = 2 w / (pi L) with the half width, not the expression that the stress is computed from.
      const double half_width = std::sqrt(4 * w * points[k].relative_radius * 2 * (1 - 0.09) / (units::pi * 206000.0));
      const double expected = w > 0.0 ? 2 * w / (units::pi * half_width) : 0.0;
      CHECK(cycle.positions[i].contact_stress[static_cast<Eigen::Index>(k)] == Approx(expected).epsilon(kRoundOff));
    }
  }
}

TEST_CASE("One pair of spur teeth carries all near the pitch point, two share elsewhere", "[core][load]") {
  constexpr double kRoundOff = 1e-12;
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const double epsilon = gears.transverse_contact_ratio;
  REQUIRE((epsilon > 1.5 && epsilon < 1.8));
  const double load = 150.0;  // N/mm
  const MeshEffects endless = MeshEffects::all_but({"free_ends"});
  const MeshModel model = mesh_cases::model(gears, {{}, equally_spaced_phases(64)}, endless);
  const LoadedCycle cycle = analyse_cycle(model, {}, torque_for(gears, load));
  REQUIRE(cycle.usable());
  int single = 0;
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const MeshPosition& at = model.positions[i];
    const LoadedPosition& loaded = cycle.positions[i];
    const int teeth = loaded_teeth(at, loaded);
    CAPTURE(at.phase, teeth);
    CHECK((teeth == 1 || teeth == 2));
    if (teeth == 1) ++single;
    double sum = 0.0;
    for (int tooth = -1; tooth <= 2; ++tooth) sum += tooth_force(at, loaded, tooth);
    CHECK(sum == Approx(cycle.force).epsilon(kRoundOff));
    // Aligned, without free ends: every tooth's line is loaded evenly.
    for (std::size_t k = 0; k < at.points.size(); ++k) {
      const double w = loaded.load.line_load[static_cast<Eigen::Index>(k)];
      CHECK(w * gears.face_width == Approx(tooth_force(at, loaded, at.points[k].tooth)).epsilon(1e-9).margin(1e-9 * cycle.force));
    }
  }
  // Of a pitch, the pair is alone for 2 - epsilon, less what tips reach early and late.
  const double share = single / 64.0;
  CHECK(share <= 2.0 - epsilon + 1.0 / 64);
  CHECK(share >= 0.5 * (2.0 - epsilon));

  const double pitch_phase = (gears.pitch_point - gears.path_start) / gears.transverse_base_pitch + 0.35;
  const MeshModel at_pitch = mesh_cases::model(gears, {{}, {pitch_phase}}, endless);
  const LoadedCycle there = analyse_cycle(at_pitch, {}, torque_for(gears, load));
  CHECK(loaded_teeth(at_pitch.positions[0], there.positions[0]) == 1);
  CHECK(there.positions[0].load.line_load.maxCoeff() == Approx(load).epsilon(1e-9));
}

TEST_CASE("A lead slope cancels the misalignment of the mesh", "[core][load]") {
  constexpr double kRoundOff = 1e-10;
  // Misalignment F opens the mesh at +z by F over the face width; a slope of -F leaves as much more metal there.
  const NamedPair named = named_pair(GENERATE(0, 1));
  CAPTURE(named.name);
  const GearPair gears = make_gear_pair(named.data);
  const MeshModel model = mesh_cases::model(gears, {{}, equally_spaced_phases(8)});
  const double misalignment = 15 * units::um, torque = torque_for(gears, 80.0);
  FlankCondition misaligned, corrected_pinion, corrected_wheel, worse;
  for (FlankCondition* c : {&misaligned, &corrected_pinion, &corrected_wheel, &worse}) {
    c->misalignment.mesh_misalignment = misalignment;
  }
  corrected_pinion.modification.pinion.lead_slope = -misalignment;
  corrected_wheel.modification.wheel.lead_slope = -misalignment;
  worse.modification.pinion.lead_slope = misalignment;
  const LoadedCycle aligned = analyse_cycle(model, {}, torque), bad = analyse_cycle(model, misaligned, torque);
  for (const FlankCondition& corrected : {corrected_pinion, corrected_wheel}) {
    const LoadedCycle good = analyse_cycle(model, corrected, torque);
    for (std::size_t i = 0; i < 8; ++i) {
      const Eigen::VectorXd& w = aligned.positions[i].load.line_load;
      CHECK((good.positions[i].load.line_load - w).lpNorm<Eigen::Infinity>() <= kRoundOff * w.maxCoeff());
      CHECK((bad.positions[i].load.line_load - w).lpNorm<Eigen::Infinity>() > 0.05 * w.maxCoeff());
    }
  }
  const double peak = summarise(model, bad).peak_line_load;
  CHECK(peak > summarise(model, aligned).peak_line_load);
  CHECK(summarise(model, analyse_cycle(model, worse, torque)).peak_line_load > peak);
}

TEST_CASE("Teeth that are all too thick move the transmission error and no load", "[core][load]") {
  constexpr double kRoundOff = 1e-9;
  const NamedPair named = named_pair(GENERATE(0, 1));
  CAPTURE(named.name);
  const GearPair gears = make_gear_pair(named.data);
  const MeshModel model = mesh_cases::model(gears, {{}, equally_spaced_phases(6)});
  FlankCondition thick;
  thick.error.pinion.cumulative_pitch = {7 * units::um};  // every tooth is as much too thick
  const double torque = torque_for(gears, 60.0);
  const LoadedCycle there = analyse_cycle(model, {}, torque);
  const double shift = -7 * units::um * std::cos(gears.base_helix_angle);
  const LoadedCycle moved = analyse_cycle(model, thick, torque);
  for (std::size_t i = 0; i < 6; ++i) {
    const LoadDistribution &a = there.positions[i].load, &b = moved.positions[i].load;
    CHECK((a.line_load - b.line_load).lpNorm<Eigen::Infinity>() <= kRoundOff * a.line_load.maxCoeff());
    CHECK(b.transmission_error - a.transmission_error == Approx(shift).epsilon(kRoundOff));
    CHECK(moved.positions[i].stiffness == Approx(there.positions[i].stiffness).epsilon(kRoundOff));
  }
}

TEST_CASE("The way through the cycle does not change its results", "[core][load]") {
  constexpr double kRoundOff = 1e-10;
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  std::vector<double> phases = equally_spaced_phases(12), reversed = phases;
  std::reverse(reversed.begin(), reversed.end());
  const MeshModel forwards = mesh_cases::model(gears, {{}, phases}), backwards = mesh_cases::model(gears, {{}, reversed});
  const double torque = torque_for(gears, 40.0);
  const LoadedCycle a = analyse_cycle(forwards, worked_condition(), torque);
  const LoadedCycle b = analyse_cycle(backwards, worked_condition(), torque);
  for (std::size_t i = 0; i < 12; ++i) {
    const LoadDistribution &there = a.positions[i].load, &back = b.positions[11 - i].load;
    CHECK((there.line_load - back.line_load).lpNorm<Eigen::Infinity>() <= kRoundOff * there.line_load.maxCoeff());
    CHECK(there.transmission_error == Approx(back.transmission_error).epsilon(kRoundOff));
  }
}

TEST_CASE("A cycle repeats after one base pitch", "[core][load]") {
  constexpr double kRoundOff = 1e-9;
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = mesh_cases::model(gears, {{}, {0.37, 1.37, -0.63}});
  const LoadedCycle cycle = analyse_cycle(model, worked_condition(), torque_for(gears, 40.0));
  for (std::size_t i : {1U, 2U}) {
    CHECK(cycle.positions[i].load.transmission_error == Approx(cycle.positions[0].load.transmission_error).epsilon(kRoundOff));
    CHECK(cycle.positions[i].load.line_load.maxCoeff() == Approx(cycle.positions[0].load.line_load.maxCoeff()).epsilon(kRoundOff));
  }
}

TEST_CASE("Bending alone makes a perfect mesh linear", "[core][load]") {
  constexpr double kRoundOff = 1e-9;
  const NamedPair named = named_pair(GENERATE(0, 1));
  CAPTURE(named.name);
  const GearPair gears = make_gear_pair(named.data);
  // On the theoretical path all points touch at no load, so that nothing but the deflection grows with it.
  const MeshModel model =
      mesh_cases::model(gears, {{}, equally_spaced_phases(6)}, MeshEffects::all_but({"hertzian_contact", "extended_contact_region"}));
  const LoadedCycle light = analyse_cycle(model, {}, torque_for(gears, 1.0));
  const LoadedCycle heavy = analyse_cycle(model, {}, torque_for(gears, 1000.0));
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(heavy.positions[i].load.transmission_error == Approx(1000.0 * light.positions[i].load.transmission_error).epsilon(kRoundOff));
    CHECK(heavy.positions[i].stiffness == Approx(light.positions[i].stiffness).epsilon(kRoundOff));
  }
}

TEST_CASE("The transmission error of a perfect mesh vanishes with the torque", "[core][load]") {
  const NamedPair named = named_pair(GENERATE(0, 1, 2, 3));
  CAPTURE(named.name);
  const GearPair gears = make_gear_pair(named.data);
  const MeshModel model = mesh_cases::model(gears, {{}, equally_spaced_phases(16)});
  double previous = 1.0;
  for (double load : {100.0, 1.0, 1e-2, 1e-4}) {
    const CycleSummary summary = summarise(model, analyse_cycle(model, {}, torque_for(gears, load)));
    CAPTURE(load);
    CHECK(summary.te_peak_to_peak < 0.1 * previous);  // deflection nearly in proportion to load
    previous = summary.te_peak_to_peak;
  }
  CHECK(summarise(model, analyse_cycle(model, {}, 0.0)).te_peak_to_peak == 0.0);
}

TEST_CASE("A summary reads the worst of the cycle", "[core][load]") {
  constexpr double kRoundOff = 1e-14;
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshModel model = mesh_cases::model(gears, {{}, equally_spaced_phases(16)});
  const LoadedCycle cycle = analyse_cycle(model, worked_condition(), torque_for(gears, 100.0));
  const CycleSummary summary = summarise(model, cycle);
  double low = 1.0, high = -1.0, load = 0.0, stress = 0.0;
  for (const LoadedPosition& at : cycle.positions) {
    low = std::min(low, at.load.transmission_error);
    high = std::max(high, at.load.transmission_error);
    load = std::max(load, at.load.line_load.maxCoeff());
    stress = std::max(stress, at.contact_stress.maxCoeff());
  }
  CHECK(summary.te_peak_to_peak == Approx(high - low).epsilon(kRoundOff));
  CHECK(summary.peak_line_load == load);
  CHECK(summary.peak_contact_stress == stress);
  CHECK(summary.worst_kkt_residual <= 1e-12);
  // The mean length of the contact lines of a spur pair is eps_alpha b.
  const double mean_load = cycle.force / (gears.transverse_contact_ratio * gears.face_width);
  CHECK(summary.load_factor == Approx(load / mean_load).epsilon(kRoundOff));
}

TEST_CASE("A position without contact points is reported instead of inventing a load", "[core][load]") {
  // A helical pair that depends on its overlap and has lost nearly all of it to an axial offset.
  PairData data = mesh_cases::pair_data(12, 13, 25, 4, 20);
  data.pinion.rack.addendum = data.wheel.rack.addendum = 0.4;
  const GearPair gears = make_gear_pair(data);
  REQUIRE(gears.transverse_contact_ratio < 0.9);
  const MeshModel model =
      make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, {{}, equally_spaced_phases(16)},
                      MeshEffects::all_but({"extended_contact_region"}), MeshPlacement::of(GapModel::PlaneOfAction, {.axial_offset = 19.5}));
  const LoadedCycle cycle = analyse_cycle(model, {}, torque_for(gears, 10.0));
  CHECK(cycle.failures > 0);
  CHECK_FALSE(cycle.usable());
  for (const LoadedPosition& at : cycle.positions) {
    if (!at.load.usable()) CHECK(at.load.status == LoadStatus::NoContactPoints);
  }
  CHECK(std::isnan(summarise(model, cycle).peak_contact_stress));
}

TEST_CASE("Positions analysed by themselves are those of the cycle", "[core][load]") {
  constexpr double solver = 1e-8;  // of the largest load: the tolerance of either solution
  const GearPair gears = make_gear_pair(named_pair(GENERATE(0, 1)).data);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 6}, equally_spaced_phases(12)});
  FlankCondition condition = worked_condition(), other = condition;
  other.modification.pinion.lead_crowning += units::um;
  const double torque = torque_for(gears, 250.0);
  const LoadedCycle whole = analyse_cycle(model, condition, torque), near = analyse_cycle(model, other, torque);
  const std::vector<std::size_t> some{0, 5, 6};
  for (const LoadedCycle* earlier : {static_cast<const LoadedCycle*>(nullptr), &near}) {
    const LoadedCycle cycle = analyse_positions(model, some, condition, torque, RootStresses::Later, earlier);
    REQUIRE(cycle.positions.size() == whole.positions.size());
    CHECK(cycle.usable());
    for (std::size_t i = 0; i < whole.positions.size(); ++i) {
      if (std::ranges::find(some, i) == some.end()) {
        CHECK_FALSE(cycle.positions[i].load.usable());
        continue;
      }
      const Eigen::VectorXd &alone = cycle.positions[i].load.line_load, &together = whole.positions[i].load.line_load;
      CHECK((alone - together).lpNorm<Eigen::Infinity>() <= solver * together.maxCoeff());
      CHECK(cycle.positions[i].contact_stress.maxCoeff() == Approx(whole.positions[i].contact_stress.maxCoeff()).epsilon(solver));
    }
  }
}
