#include "core/fidelity/cycle_extremes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/fidelity/edge_approach.hpp"
#include "core/fidelity/resolved_cycle.hpp"
#include "core/gear/both_gears.hpp"
#include "core/rating/contact_temperature.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;
using mesh_cases::mesh_of;
using mesh_cases::torque_for;

namespace {

struct Extremes {
  double te_high, te_low, stress, load;
};

Extremes extremes_of(const LoadedCycle& cycle) {
  const Eigen::VectorXd te = cycle.transmission_error();
  Extremes found{te.maxCoeff(), te.minCoeff(), 0.0, 0.0};
  for (const LoadedPosition& position : cycle.positions) {
    found.stress = std::max(found.stress, position.contact_stress.maxCoeff());
    found.load = std::max(found.load, position.load.line_load.maxCoeff());
  }
  return found;
}

/// Spur and helical, crowned, misaligned and relieved: kinks of every sort.
GearPair drawn_pair() {
  return GENERATE(mesh_cases::pair(25, 50, 0, 3, 30), mesh_cases::pair(18, 54, 30, 10, 120), mesh_cases::pair(23, 67, 12, 2, 40));
}

/// Crowned and of small helix angle, with roundings: the wheel's edge begins to carry between 4 and 12 N·m.
GearPair crowned_pair(double helix) {
  PairData data = mesh_cases::pair_data(18, 38, helix, 3, 10);
  data.pinion.tip_rounding = data.wheel.tip_rounding = 0.15;
  return make_gear_pair(data);
}

FlankCondition crowned_condition() {
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 10 * units::um;
  condition.modification.pinion.tip_relief = {15 * units::um, 0.8, ReliefShape::Linear};
  condition.modification.wheel.tip_relief = {5 * units::um, 1.5, ReliefShape::Linear};
  return condition;
}

}  // namespace

TEST_CASE("Extremes between few positions are those of many", "[core][load][extremes]") {
  const GearPair gears = drawn_pair();
  const bool modified = GENERATE(false, true);
  const FlankCondition condition = modified ? mesh_cases::worked_condition() : FlankCondition{};
  const MeshAt mesh_at = mesh_of(gears, {QuadratureRule::Graded, 4});
  const double torque = torque_for(gears, 120);
  const MeshModel model = mesh_at(equally_spaced_phases(32));
  const LoadedCycle cycle = analyse_cycle(model, condition, torque);
  const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) { return mesh_at(phases); };
  const ResolvedCycle resolved = resolve_cycle(model, cycle, at, condition, torque, {});
  const Extremes many = extremes_of(analyse_cycle(mesh_at(equally_spaced_phases(1024)), condition, torque));
  CAPTURE(resolved.extremes.looked_at, resolved.extremes.phases);
  // What the search leaves, by its tolerance, where curves are as straight as it takes them for, and 1024 positions.
  const double kSearch = ExtremeSearch{}.tolerance, kPositions = 4e-3;
  const double variation = many.te_high - many.te_low;
  CHECK(std::abs(resolved.summary.te_peak_to_peak - variation) <= (2 * kSearch + kPositions) * std::max(variation, 0.02 * resolved.summary.te_mean));
  CHECK(resolved.summary.peak_contact_stress == Approx(many.stress).epsilon(kSearch + kPositions));
  CHECK(resolved.summary.peak_line_load == Approx(many.load).epsilon(kSearch + 2 * kPositions));  // stress is its root
  CHECK(resolved.extremes.looked_at <= ExtremeSearch{}.most + 4);
}

TEST_CASE("Extremes are never smaller than those of the positions, and are solved for", "[core][load][extremes]") {
  const GearPair gears = drawn_pair();
  const FlankCondition condition = mesh_cases::worked_condition();
  const MeshAt mesh_at = mesh_of(gears, {QuadratureRule::Graded, 4});
  const double torque = torque_for(gears, 60);
  const MeshModel model = mesh_at(equally_spaced_phases(16));
  const LoadedCycle cycle = analyse_cycle(model, condition, torque);
  const CycleExtremes found = locate_extremes(model, mesh_at, condition, torque, cycle);
  CHECK(std::ranges::is_sorted(found.phases));
  for (const double rise : found.unseen) CHECK(rise >= 0.0);
  if (found.phases.empty()) return;
  const Extremes at_positions = extremes_of(cycle), further = extremes_of(analyse_cycle(mesh_at(found.phases), condition, torque));
  const bool some = further.te_high > at_positions.te_high || further.te_low < at_positions.te_low || further.stress > at_positions.stress ||
                    further.load > at_positions.load;
  CHECK(some);
}

TEST_CASE("A tip edge that carries for less than the spacing of the positions is found", "[core][load][extremes]") {
  PairData data = mesh_cases::pair_data(25, 50, 0, 3, 30);
  data.pinion.tip_rounding = data.wheel.tip_rounding = 0.3;
  const GearPair gears = make_gear_pair(data);
  FlankCondition condition;
  condition.modification.pinion.tip_relief = condition.modification.wheel.tip_relief = {12 * units::um, 1.0, ReliefShape::Linear};
  const MeshAt mesh_at = mesh_of(gears, {QuadratureRule::Graded, 4});
  const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) { return mesh_at(phases); };
  const MeshModel model = mesh_at(equally_spaced_phases(32)), many = mesh_at(equally_spaced_phases(512));
  constexpr double kSearch = 2e-3, kSpike = 8e-3;  // tolerance of the search; a spike has a round top, and 512 positions have a dozen on it
  int seen = 0;
  for (int line_load = 100; line_load <= 400; line_load += 20) {  // over these loads the edges of both gears begin to carry
    const double torque = torque_for(gears, line_load);
    const LoadedCycle cycle = analyse_cycle(model, condition, torque);
    const ResolvedCycle resolved = resolve_cycle(model, cycle, at, condition, torque, {});
    const Extremes found = extremes_of(analyse_cycle(many, condition, torque));
    CAPTURE(line_load, resolved.extremes.looked_at, resolved.extremes.phases);
    CHECK(resolved.summary.peak_contact_stress == Approx(found.stress).epsilon(kSearch + kSpike));
    if (extremes_of(cycle).stress < 0.97 * found.stress) ++seen;
  }
  CHECK(seen > 0);  // of these loads, with a spike that the positions miss
}

TEST_CASE("A tip edge is found that carries over part of a crowned face, between two positions", "[core][load][extremes]") {
  // A line takes three to seven spacings to pass the edge; the loaded part of the face takes less than one.
  const double helix = GENERATE(4.6, 5.0691, 8.0, 11.0);
  const GearPair gears = crowned_pair(helix);
  const FlankCondition condition = crowned_condition();
  const MeshAt mesh_at = mesh_of(gears, {QuadratureRule::Graded, 12});
  const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) { return mesh_at(phases); };
  const MeshModel model = mesh_at(equally_spaced_phases(32)), many = mesh_at(equally_spaced_phases(512));
  constexpr double kSearch = 2e-3, kSpike = 8e-3;  // as above
  int seen = 0;
  for (double torque = 4e3; torque < 12e3; torque += 0.25e3) {  // over these the wheel's edge begins to carry
    const LoadedCycle cycle = analyse_cycle(model, condition, torque);
    const ResolvedCycle resolved = resolve_cycle(model, cycle, at, condition, torque, {});
    const Extremes found = extremes_of(analyse_cycle(many, condition, torque));
    CAPTURE(helix, torque, resolved.extremes.looked_at, resolved.extremes.phases);
    CHECK(resolved.summary.peak_contact_stress == Approx(found.stress).epsilon(kSearch + kSpike));
    if (extremes_of(cycle).stress < 0.97 * found.stress) ++seen;
  }
  CHECK(seen > 0);
}

TEST_CASE("The approach of an edge is above 0 where the edge has a stress, and nowhere else", "[core][load][extremes]") {
  const GearPair gears = crowned_pair(GENERATE(0.0, 5.0, 12.0, 25.0));
  // Where a relief is steep, flanks touch beside the edge although the point lies beyond it.
  FlankCondition condition = crowned_condition();
  condition.modification.wheel.tip_relief.height = GENERATE(0.3, 1.5);
  const MeshModel model = mesh_of(gears, {QuadratureRule::Graded, 6})(equally_spaced_phases(64));
  int pressed = 0, clear = 0;
  for (const double torque : {4e3, 8e3, 12e3, 40e3}) {
    const LoadedCycle cycle = analyse_cycle(model, condition, torque);
    for (std::size_t p = 0; p < model.positions.size(); ++p) {
      const LoadedPosition& loaded = cycle.positions[p];
      PerGear<double> on_edge{0.0, 0.0};
      for (std::size_t i = 0; i < model.positions[p].points.size(); ++i) {
        double& of_gear = on_edge[model.positions[p].points[i].tip_edge.gear];
        of_gear = std::max(of_gear, loaded.edge_stress[static_cast<Eigen::Index>(i)]);
      }
      for (const Member m : both_gears) {
        const EdgeApproach edge = edge_approach(model.positions[p], loaded, m);
        CAPTURE(torque, p, name_of(m), edge.approach, on_edge[m]);
        CHECK((edge.approach > 0.0) == (on_edge[m] > 0.0));
        if (edge.approach > 0.0) {
          // The edge stress is the largest of all points and of places between them; the deepest point has most of it.
          const double there = edge_pressure_at(model.positions[p], loaded, edge, edge.approach);
          CHECK(there <= on_edge[m] * (1.0 + 1e-9));  // round-off of the law's inverse
          CHECK(there > 0.0);
        }
        ++(on_edge[m] > 0.0 ? pressed : clear);
      }
    }
  }
  CHECK(pressed > 0);
  CHECK(clear > 0);
}

TEST_CASE("An edge that is not seen to touch has an error where a finer look sees it touch", "[core][load][extremes]") {
  const double helix = GENERATE(0.0, 5.0, 12.0);
  const GearPair gears = crowned_pair(helix);
  const FlankCondition condition = crowned_condition();
  const std::vector<double> phases = equally_spaced_phases(16);
  const MeshAt mesh_at = mesh_of(gears, {QuadratureRule::Graded, 6}), coarse_at = mesh_of(gears, {QuadratureRule::Graded, 3});
  const MeshWithParameters at = [&](const std::vector<double>& of, const std::vector<MeshParameter>&) { return mesh_at(of); };
  const MeshModel model = mesh_at(phases), coarse_model = coarse_at(coarse_phases(phases));
  const MeshModel many = mesh_of(gears, {QuadratureRule::Graded, 24})(equally_spaced_phases(256));
  const auto resolved_under = [&](double torque) {
    const LoadedCycle coarse = analyse_cycle(coarse_model, condition, torque);
    const CycleResolving resolving{.coarse = &coarse, .coarse_model = &coarse_model, .coarse_at = coarse_at};
    return resolve_cycle(model, analyse_cycle(model, condition, torque), at, condition, torque, resolving);
  };
  const auto fine_under = [&](double torque) {
    double stress = 0.0;
    for (const LoadedPosition& position : analyse_cycle(many, condition, torque).positions)
      stress = std::max(stress, position.edge_stress.maxCoeff());
    return stress;
  };
  // The least torque that the coarser one sees touch.
  double clear = 1e3, touching = 16e3;
  REQUIRE(resolved_under(clear).summary.edge_stress == 0.0);
  REQUIRE(resolved_under(touching).summary.edge_stress > 0.0);
  while (touching - clear > 1e-3 * touching) {
    const double between = 0.5 * (clear + touching);
    (resolved_under(between).summary.edge_stress > 0.0 ? touching : clear) = between;
  }
  const ResolvedCycle just_clear = resolved_under(clear);
  CAPTURE(helix, clear, just_clear.errors.edge_stress, fine_under(clear));
  CHECK(just_clear.errors.edge_stress > 0.0);
  CHECK(fine_under(clear) <= just_clear.errors.edge_stress);
  // Much less torque leaves a gap that no error closes.
  CHECK(resolved_under(0.7 * clear).errors.edge_stress == 0.0);
  CHECK(fine_under(0.7 * clear) == 0.0);
}

TEST_CASE("The largest value of a further reading lies between the positions, and its error says how sure it is", "[core][load][extremes]") {
  // Friction heats most where much slides: at the ends of the path, often on a tip edge, where neither stress nor load has its peak.
  const GearPair gears = drawn_pair();
  const FlankCondition condition = mesh_cases::worked_condition();
  const double torque = torque_for(gears, 120);
  const FilmCondition film{.speed = 300.0, .oil_temperature = 80.0, .bulk_temperature = 100.0, .friction = 0.05, .roughness = 0.4};
  const PointReading flash = [&](const LoadedPoint& at) { return flash_temperature(gears, at, film, HeatSource::Hertzian); };
  const MeshAt mesh_at = mesh_of(gears, {QuadratureRule::Graded, 8}), coarse_at = mesh_of(gears, {QuadratureRule::Graded, 4});
  const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) { return mesh_at(phases); };
  const std::vector<double> phases = equally_spaced_phases(32);
  const MeshModel model = mesh_at(phases), coarse_model = coarse_at(coarse_phases(phases));
  const LoadedCycle cycle = analyse_cycle(model, condition, torque), coarse = analyse_cycle(coarse_model, condition, torque);
  const CycleResolving resolving{.coarse = &coarse, .coarse_model = &coarse_model, .coarse_at = coarse_at, .further = {flash}};
  const ResolvedCycle resolved = resolve_cycle(model, cycle, at, condition, torque, resolving);
  REQUIRE(resolved.further.size() == 1);
  const auto largest = [&](const MeshModel& mesh) {
    const LoadedCycle solved = analyse_cycle(mesh, condition, torque);
    double hottest = 0.0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      hottest = std::max(hottest, largest_of_points(flash)(mesh.positions[i], solved.positions[i]));
    }
    return hottest;
  };
  const double many = largest(mesh_at(equally_spaced_phases(512))), kSearch = ExtremeSearch{}.tolerance, kPositions = 4e-3;
  CAPTURE(resolved.extremes.looked_at, largest(model));
  CHECK(resolved.further[0].value == Approx(many).epsilon(kSearch + kPositions));
  const double fine = largest(mesh_of(gears, {QuadratureRule::Graded, 32})(equally_spaced_phases(256)));
  CHECK(std::abs(resolved.further[0].value - fine) <= resolved.further[0].error() + kPositions * fine);
}

TEST_CASE("Without load, or with too few positions, there is nothing to seek", "[core][load][extremes]") {
  const GearPair gears = mesh_cases::pair(25, 50, 0, 3, 30);
  const MeshAt mesh_at = mesh_of(gears);
  const MeshModel eight = mesh_at(equally_spaced_phases(8)), three = mesh_at(equally_spaced_phases(3));
  CHECK(locate_extremes(eight, mesh_at, {}, 0.0, analyse_cycle(eight, {}, 0.0)).looked_at == 0);
  CHECK(locate_extremes(three, mesh_at, {}, 1e5, analyse_cycle(three, {}, 1e5)).looked_at == 0);
}
