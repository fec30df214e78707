#include "core/fidelity/resolved_analysis.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/fidelity/resolution_level.hpp"
#include "tests/common/random.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

struct LoadCase {
  GearPair gears;
  FlankCondition condition;
  double torque{0.0};

  MeshOfResolution mesh() const {
    return [this](const MeshResolution& resolution) { return mesh_cases::model(gears, resolution); };
  }
  ResolvedAnalysis resolved(const AutomaticResolution& automatic) const { return analyse_resolved(mesh(), condition, torque, automatic); }
};

/// Pairs, flanks, misalignments and torques of all sorts; a quarter of the pairs are spur gears.
/// @param widest  face width [m_n]
LoadCase random_case(unsigned seed, double widest = 15.0) {
  tests::Random32 random(seed);
  const auto amount = [&](double low, double high) { return random(low, high) * units::um; };
  const double module = random(1.0, 10.0), helix = random.chance(0.25) ? 0.0 : random(5.0, 32.0);
  const int teeth = static_cast<int>(random(17.0, 50.0));
  LoadCase drawn{mesh_cases::pair(teeth, static_cast<int>(teeth * random(1.0, 4.0)), helix, module, module * random(4.0, widest)), {}};
  FlankCondition& c = drawn.condition;
  if (random.chance(0.6)) c.modification.pinion.lead_crowning = amount(2, 15);
  if (random.chance(0.4)) c.modification.pinion.addendum_crowning = c.modification.pinion.dedendum_crowning = amount(1, 10);
  for (Modification* modification : {&c.modification.pinion, &c.modification.wheel}) {
    if (!random.chance(0.4)) continue;
    const ReliefShape shape = random.chance(0.5) ? ReliefShape::Linear : ReliefShape::Parabolic;
    modification->tip_relief = {amount(3, 30), module * random(0.2, 0.6), shape};
  }
  if (random.chance(0.7)) c.misalignment.mesh_misalignment = amount(-20, 20);
  if (random.chance(0.3)) c.error.pinion.helix_slope = amount(-8, 8);
  drawn.torque = mesh_cases::torque_for(drawn.gears, module * random(4.0, 40.0));
  return drawn;
}

CycleFigures figures_of(const ResolvedAnalysis& analysis) { return flankwright::figures_of(analysis.cycle, analysis.resolved.summary); }

int cost_of(const ResolvedAnalysis& analysis) {
  return analysis.resolution.quadrature.intervals * static_cast<int>(analysis.resolution.phases.size());
}

struct Honesty {
  int drawn{0}, within{0}, over_tenfold{0}, not_kept{0};
};

/// Resolves random load cases and compares with at least three times the intervals and four times the positions.
Honesty honesty(unsigned first, int count, double widest, const AutomaticResolution& automatic) {
  Honesty result;
  for (unsigned seed = first; seed < first + static_cast<unsigned>(count); ++seed) {
    const LoadCase drawn = random_case(seed, widest);
    const ResolvedAnalysis found = drawn.resolved(automatic);
    const int intervals = found.resolution.quadrature.intervals, positions = static_cast<int>(found.resolution.phases.size());
    const ResolvedAnalysis truth = drawn.resolved({.accuracy = automatic.accuracy,
                                                   .intervals = std::max(16, 3 * intervals),
                                                   .positions = std::max(64, 4 * positions),
                                                   .choose_intervals = false,
                                                   .choose_positions = false});
    const double error = largest(figure_errors(figures_of(found), figures_of(truth)));
    const double stated = largest(error_shares(found.resolved.errors, figures_of(found)));
    UNSCOPED_INFO(seed << ": stated " << 100 * stated << " %, found " << 100 * error << " % with " << intervals << " intervals, " << positions
                       << " positions" << (found.error <= automatic.accuracy ? "" : ", not kept"));
    ++result.drawn;
    result.within += error <= stated ? 1 : 0;
    result.over_tenfold += stated > 10.0 * error ? 1 : 0;
    result.not_kept += found.error <= automatic.accuracy ? 0 : 1;
  }
  return result;
}

}  // namespace

TEST_CASE("Estimated errors of a resolution hold on random load cases", "[core][fidelity]") {
  const Honesty found = honesty(1000, 20, 6.0, {.accuracy = 0.05, .intervals = 6, .positions = 16, .most_intervals = 24, .most_positions = 64});
  CAPTURE(found.within, found.over_tenfold, found.not_kept);
  CHECK(found.within >= 19);  // 95 %: differences may cancel by chance
  CHECK(found.over_tenfold <= 5);
}

TEST_CASE("Estimated errors of a resolution hold on 200 random load cases", "[core][fidelity][.soak]") {
  const Honesty found = honesty(0, 200, 15.0, {.accuracy = 0.01, .intervals = 6, .positions = 16});
  WARN("within " << found.within << " of " << found.drawn << ", over tenfold " << found.over_tenfold << ", not kept " << found.not_kept);
  CHECK(found.within >= 190);  // 95 %: differences may cancel by chance
  CHECK(found.over_tenfold <= 50);
}

TEST_CASE("A line that is loaded evenly needs no more than the fewest intervals", "[core][fidelity]") {
  // Aligned, unmodified spur flanks without free ends: the load is the same along the line, whatever the quadrature.
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshOfResolution endless = [&](const MeshResolution& resolution) {
    return mesh_cases::model(gears, resolution, MeshEffects::all_but({"free_ends"}));
  };
  constexpr int fewest = 6;
  const ResolvedAnalysis found = analyse_resolved(endless, {}, 200e3, {.accuracy = 0.01, .intervals = fewest, .positions = 16});
  CHECK(found.resolution.quadrature.intervals == fewest);
  constexpr double kRoundOff = 1e-9;
  const CycleFigures figures = figures_of(found);
  CHECK(largest(error_shares(found.resolved.error_parts.points, figures)) < kRoundOff);
  CHECK(largest(error_shares(found.resolved.error_parts.positions, figures)) > kRoundOff);  // teeth come and go between positions
}

TEST_CASE("More accuracy never takes a coarser resolution, and what is kept is within it", "[core][fidelity]") {
  const LoadCase drawn = random_case(7, 6.0);
  int cost = 0;
  for (double accuracy : {0.3, 0.1, 0.03}) {
    const ResolvedAnalysis found = drawn.resolved({.accuracy = accuracy, .intervals = 6, .positions = 16});
    CAPTURE(accuracy, found.resolution.quadrature.intervals, found.resolution.phases.size());
    CHECK(found.error <= accuracy);
    CHECK(cost_of(found) >= cost);
    cost = cost_of(found);
  }
}

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
