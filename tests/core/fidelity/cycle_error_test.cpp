#include "core/fidelity/cycle_error.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/fidelity/cycle_quantities.hpp"
#include "core/fidelity/resolution_level.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

/// A cycle with `intervals`, compared with half of them, or with twice as many after that.
struct Judged {
  ResolvedCycle resolved;
  CycleFigures figures;
};
enum class BesideFiner { No, Yes };

Judged judge(const GearPair& gears, const FlankCondition& condition, double torque, int intervals, int positions,
             BesideFiner beside_finer = BesideFiner::No) {
  const std::vector<double> phases = equally_spaced_phases(positions);
  const auto mesh = [&](int n, const std::vector<double>& at) { return mesh_cases::model(gears, {{QuadratureRule::Graded, n}, at}); };
  const MeshModel model = mesh(intervals, phases);
  const LoadedCycle cycle = analyse_cycle(model, condition, torque),
                    coarse = analyse_cycle(mesh(intervals / 2, coarse_phases(phases)), condition, torque);
  const MeshWithParameters at = [&](const std::vector<double>& some, const std::vector<MeshParameter>&) { return mesh(intervals, some); };
  ResolvedCycle resolved = resolve_cycle(model, cycle, at, condition, torque, {.coarse = &coarse});
  if (beside_finer == BesideFiner::Yes) {
    const MeshModel finer = mesh(2 * intervals, phases);
    const LoadedCycle of_finer = analyse_cycle(finer, condition, torque);
    hold_against_finer({&model, &cycle}, {&finer, &of_finer}, {}, resolved);
  }
  return {resolved, figures_of(cycle, resolved.summary)};
}

}  // namespace

TEST_CASE("The stated error of a figure holds beside a cycle four times finer both ways", "[core][load][cycle-error]") {
  const GearPair gears = GENERATE(mesh_cases::pair(25, 50, 0, 3, 30), mesh_cases::pair(18, 54, 30, 10, 120), mesh_cases::pair(23, 67, 12, 2, 40));
  const double line_load = GENERATE(40.0, 200.0);
  const FlankCondition condition = mesh_cases::worked_condition();
  const double torque = mesh_cases::torque_for(gears, line_load);
  const Judged coarse = judge(gears, condition, torque, 8, 32), fine = judge(gears, condition, torque, 32, 128);
  const PerFigure stated = error_shares(coarse.resolved.errors, coarse.figures), found = figure_errors(coarse.figures, fine.figures);
  for (const Figure figure : {Figure::TeMean, Figure::TePeakToPeak, Figure::TeHarmonic1, Figure::PeakContactStress}) {
    const auto i = static_cast<std::size_t>(figure);
    CAPTURE(gears.pinion.data.teeth, line_load, name_of(figure), stated[i], found[i], coarse.resolved.extremes.phases,
            coarse.resolved.extremes.looked_at);
    CAPTURE(coarse.resolved.summary.te_peak_to_peak, fine.resolved.summary.te_peak_to_peak, coarse.resolved.error_parts.points.te_peak_to_peak,
            coarse.resolved.error_parts.positions.te_peak_to_peak);
    CHECK(found[i] <= stated[i]);
    CHECK(stated[i] < 0.5);  // and says something
  }
  // What four times finer leaves is less than what is stated coarsely.
  CHECK(largest(error_shares(fine.resolved.errors, fine.figures)) < largest(stated));
}

TEST_CASE("The stated errors of the stiffness hold beside a cycle four times finer both ways", "[core][load][cycle-error]") {
  const GearPair gears = GENERATE(mesh_cases::pair(25, 50, 0, 3, 30), mesh_cases::pair(18, 54, 30, 10, 120), mesh_cases::pair(23, 67, 12, 2, 40));
  const double line_load = GENERATE(5.0, 40.0, 200.0);
  const FlankCondition condition = mesh_cases::worked_condition();
  const double torque = mesh_cases::torque_for(gears, line_load);
  const ResolvedCycle coarse = judge(gears, condition, torque, 12, 32).resolved, fine = judge(gears, condition, torque, 48, 128).resolved;
  for (const std::string_view name : {"mean_stiffness", "least_stiffness", "largest_stiffness", "stiffness_variation"}) {
    const CycleEntry entry = find_cycle_entry(name);
    const double found = entry.value(coarse.summary), stated = entry.error(coarse.errors, coarse.summary), expected = entry.value(fine.summary);
    CAPTURE(gears.pinion.data.teeth, line_load, name, found, expected, stated);
    CHECK(std::abs(found - expected) <= stated);
    if (line_load > 5.0) CHECK(stated < 0.6 * expected);  // and says something; under so little load a few points carry all
  }
}

TEST_CASE("Where a pitch deviation lets the curve jump at the end of a pitch, the errors of mean and harmonics are of order one",
          "[core][load][cycle-error]") {
  const GearPair gears = mesh_cases::pair(25, 50, 0, 3, 30);
  FlankCondition condition = mesh_cases::worked_condition();
  condition.error.wheel.pitch_step = 4.0 * units::um;
  const double torque = mesh_cases::torque_for(gears, GENERATE(40.0, 200.0));
  const ResolvedCycle coarse = judge(gears, condition, torque, 8, 32).resolved, fine = judge(gears, condition, torque, 16, 256).resolved;
  CHECK(std::abs(coarse.summary.te_mean - fine.summary.te_mean) <= coarse.errors.te_mean);
  for (std::size_t k = 0; k < 4; ++k) {
    CAPTURE(k, coarse.summary.te_harmonics[k], fine.summary.te_harmonics[k]);
    CHECK(std::abs(coarse.summary.te_harmonics[k] - fine.summary.te_harmonics[k]) <= coarse.errors.te_harmonics[k]);
  }
}

TEST_CASE("The error of a mean and of a peak covers what a kinked curve's samples leave out", "[core][load][cycle-error]") {
  // 1 + a |sin(pi (x - s))| has a kink at s and the mean 1 + 2 a/pi; with half the intervals every reading is higher by `points`, as order one would have it
  // another half of that is missing.
  const double shift = GENERATE(0.0, 0.013, 0.031, 0.05), points = GENERATE(0.0, 0.02);
  const int positions = GENERATE(8, 16, 32);
  constexpr double a = 0.4;
  const auto curve = [&](int n, double higher) {
    std::vector<double> samples;
    for (int i = 0; i < n; ++i) samples.push_back(1.0 + a * std::abs(std::sin(units::pi * (static_cast<double>(i) / n - shift))) + higher);
    return samples;
  };
  const std::vector<double> fine = curve(positions, 0.5 * points), coarse = curve(positions / 2, points);
  double mean = 0.0;
  for (const double value : fine) mean += value / positions;
  CAPTURE(shift, points, positions);
  const double of_mean = mean_error(fine, coarse), of_peak = peak_error_by_points({fine, coarse}) + unseen_rise(fine);
  CHECK(std::abs(mean - (1.0 + 2.0 * a / units::pi)) <= 2.0 * of_mean);  // the share of a mean by points is that of order two
  CHECK(std::abs(*std::ranges::max_element(fine) - (1.0 + a)) <= of_peak);
  CHECK(of_mean <= 0.5 * points + 0.1 * a);
  CHECK(of_peak <= points + 0.1 * a);
}

TEST_CASE("Held against a finer cycle, the errors by points are no wider and still hold", "[core][load][cycle-error]") {
  const GearPair gears = GENERATE(mesh_cases::pair(25, 50, 0, 3, 30), mesh_cases::pair(18, 54, 30, 10, 120), mesh_cases::pair(23, 67, 12, 2, 40));
  const double line_load = GENERATE(40.0, 200.0);
  const FlankCondition condition = mesh_cases::worked_condition();
  const double torque = mesh_cases::torque_for(gears, line_load);
  const Judged half = judge(gears, condition, torque, 8, 32), twice = judge(gears, condition, torque, 8, 32, BesideFiner::Yes),
               fine = judge(gears, condition, torque, 32, 128);
  const PerFigure by_half = error_shares(half.resolved.errors, half.figures), stated = error_shares(twice.resolved.errors, twice.figures),
                  found = figure_errors(half.figures, fine.figures);
  CHECK(twice.resolved.errors.te_peak_to_peak == twice.resolved.error_parts.sum(twice.resolved.summary).te_peak_to_peak);
  CHECK(twice.resolved.error_parts.positions.te_peak_to_peak == half.resolved.error_parts.positions.te_peak_to_peak);
  for (const Figure figure : {Figure::TeMean, Figure::TePeakToPeak, Figure::TeHarmonic1, Figure::PeakContactStress}) {
    const auto i = static_cast<std::size_t>(figure);
    CAPTURE(gears.pinion.data.teeth, line_load, name_of(figure), by_half[i], stated[i], found[i]);
    CHECK(found[i] <= stated[i]);
    CHECK(stated[i] <= by_half[i]);
  }
}

TEST_CASE("A finer cycle that agrees leaves no error by points", "[core][load][cycle-error]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const FlankCondition condition = mesh_cases::worked_condition();
  const double torque = mesh_cases::torque_for(gears, 100);
  const auto mesh = [&](int n, const std::vector<double>& at) { return mesh_cases::model(gears, {{QuadratureRule::Graded, n}, at}); };
  const std::vector<double> phases = equally_spaced_phases(16);
  const MeshModel model = mesh(6, phases);
  const LoadedCycle cycle = analyse_cycle(model, condition, torque), coarse = analyse_cycle(mesh(3, coarse_phases(phases)), condition, torque);
  const MeshWithParameters at = [&](const std::vector<double>& some, const std::vector<MeshParameter>&) { return mesh(6, some); };
  ResolvedCycle resolved = resolve_cycle(model, cycle, at, condition, torque, {.coarse = &coarse});
  CHECK(resolved.error_parts.points.peak_contact_stress > 0.0);
  hold_against_finer({&model, &cycle}, {&model, &cycle}, {}, resolved);
  const CycleErrors& points = resolved.error_parts.points;
  CHECK(points.te_mean == 0.0);
  CHECK(points.te_peak_to_peak == 0.0);
  CHECK(points.peak_line_load == 0.0);
  CHECK(points.peak_contact_stress == 0.0);
  for (const double harmonic : points.te_harmonics) CHECK(harmonic == 0.0);
  CHECK(resolved.errors.peak_contact_stress == resolved.error_parts.positions.peak_contact_stress);
}

TEST_CASE("An error that is stated smaller than what a finer cycle changes is replaced by what the finer one says", "[core][load][cycle-error]") {
  const GearPair gears = mesh_cases::pair(25, 50, 0, 3, 30);
  const FlankCondition condition = mesh_cases::worked_condition();
  const double torque = mesh_cases::torque_for(gears, 100);
  const auto mesh = [&](int intervals) { return mesh_cases::model(gears, {{QuadratureRule::Graded, intervals}, equally_spaced_phases(16)}); };
  const MeshModel model = mesh(6), finer_model = mesh(12);
  const LoadedCycle cycle = analyse_cycle(model, condition, torque), finer = analyse_cycle(finer_model, condition, torque);
  const CycleSummary summary = summarise(model, cycle), of_finer = summarise(finer_model, finer);
  CycleErrors none, wide;
  for (const auto of : CycleErrors::single()) {
    none.*of = 0.0;
    wide.*of = INFINITY;
  }
  const CycleErrors instead_of_none = point_errors_beside_finer(none, cycle, summary, finer, of_finer);
  const CycleErrors instead_of_wide = point_errors_beside_finer(wide, cycle, summary, finer, of_finer);
  REQUIRE(summary.peak_contact_stress != of_finer.peak_contact_stress);
  for (const auto of : CycleErrors::single()) {
    const double change = std::abs(summary.*of - of_finer.*of);
    CAPTURE(change, instead_of_none.*of, instead_of_wide.*of);
    // Of a figure that this pair has, whose error is estimated, and that points along the lines matter to.
    if (!(change > 0.0) || !std::isfinite(instead_of_wide.*of)) continue;
    CHECK(instead_of_none.*of >= change);
    CHECK(instead_of_none.*of == instead_of_wide.*of);
  }
}

TEST_CASE("Errors are those of points and of positions together, and not known without a coarser cycle", "[core][load][cycle-error]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const Judged judged = judge(gears, mesh_cases::worked_condition(), mesh_cases::torque_for(gears, 100), 6, 16);
  const CycleErrorParts& parts = judged.resolved.error_parts;
  CHECK(judged.resolved.errors.te_peak_to_peak == parts.points.te_peak_to_peak + parts.positions.te_peak_to_peak);
  CHECK(judged.resolved.errors.te_harmonics.size() == judged.resolved.summary.te_harmonics.size());
  CHECK(std::isnan(CycleErrors{}.te_mean));
  CHECK(coarse_phases(equally_spaced_phases(16)).size() == 8);
  CHECK(coarse_phases(equally_spaced_phases(9)).size() == 9);
}
