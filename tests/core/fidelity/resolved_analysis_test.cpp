#include "core/fidelity/resolved_analysis.hpp"

#include <catch2/catch.hpp>

#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

TEST_CASE("An analysis that chooses its resolution doubles it until the figures are known well enough", "[fidelity]") {
  const GearPair gears = mesh_cases::pair(20, 40, 20.0, 3.0, 30.0);
  FlankCondition condition;
  condition.misalignment.mesh_misalignment = 20 * units::um;
  const double torque = mesh_cases::torque_for(gears, 60.0);
  const auto mesh_for = [&](const MeshResolution& resolution) { return mesh_cases::model(gears, resolution); };
  const AutomaticResolution coarse{.accuracy = 0.02, .intervals = 4, .positions = 8};

  const ResolvedAnalysis found = analyse_resolved(mesh_for, condition, torque, coarse);
  CHECK(found.error <= coarse.accuracy);
  CHECK(found.resolution.quadrature.intervals * static_cast<int>(found.resolution.phases.size()) > coarse.intervals * coarse.positions);
  CHECK(found.cycle.positions.size() == found.resolution.phases.size());
  // Discretisation: what is stated holds against a resolution that is finer by far.
  const ResolvedAnalysis fine = analyse_resolved(mesh_for, condition, torque, {.accuracy = 1e-9, .intervals = 48, .positions = 128});
  CHECK(fine.resolution.quadrature.intervals == 48);
  CHECK(found.resolved.summary.peak_contact_stress == Approx(fine.resolved.summary.peak_contact_stress).epsilon(coarse.accuracy));
  CHECK(found.resolved.summary.te_peak_to_peak == Approx(fine.resolved.summary.te_peak_to_peak).epsilon(coarse.accuracy));

  // What is given stays.
  AutomaticResolution given = coarse;
  given.choose_intervals = given.choose_positions = false;
  const ResolvedAnalysis as_given = analyse_resolved(mesh_for, condition, torque, given);
  CHECK(as_given.resolution.phases.size() == 8);
  CHECK(as_given.error > coarse.accuracy);
}

TEST_CASE("Intervals are not doubled for the error of positions, nor positions for that of intervals", "[fidelity]") {
  const GearPair gears = mesh_cases::pair(20, 40, 20.0, 3.0, 30.0);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 4}, equally_spaced_phases(8)});
  const LoadedCycle cycle = analyse_cycle(model, {}, mesh_cases::torque_for(gears, 60.0));
  ResolvedCycle resolved;
  resolved.summary = summarise(model, cycle);
  const auto with = [&](double points, double positions) {  // shares of the stress, which alone counts
    CycleErrors none;
    none.te_peak_to_peak = 0.0;
    resolved.error_parts = {none, none};
    resolved.error_parts.points.peak_contact_stress = points * resolved.summary.peak_contact_stress;
    resolved.error_parts.positions.peak_contact_stress = positions * resolved.summary.peak_contact_stress;
    return resolved;
  };
  const AutomaticResolution finest_lines{.accuracy = 0.01, .intervals = 48, .positions = 32},
      finest_cycle{.accuracy = 0.01, .intervals = 12, .positions = 128};
  AutomaticResolution from = finest_lines;
  CHECK_FALSE(refine(from, with(0.03, 0.005), cycle));
  CHECK(from.positions == 32);
  CHECK(refine(from, with(0.03, 0.02), cycle));  // here positions still help, if not enough
  CHECK(from.positions == 64);
  from = finest_cycle;
  CHECK_FALSE(refine(from, with(0.005, 0.03), cycle));
  CHECK(refine(from, with(0.03, 0.005), cycle));
  CHECK(from.intervals == 24);
}
