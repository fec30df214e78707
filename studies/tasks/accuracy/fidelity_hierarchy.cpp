#include "studies/tasks/accuracy/fidelity_hierarchy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <ranges>
#include <span>

#include "core/base/limit_estimate.hpp"
#include "core/base/stopwatch.hpp"
#include "core/contact/unloaded/transmission_error.hpp"
#include "studies/tasks/accuracy/accuracy_table.hpp"

namespace flankwright::studies {

namespace {

/// Orders 1 to 5 of the transmission error need 11 positions at least.
constexpr int fewest_positions = 12;
constexpr const char* finest_name = "finest";
constexpr const char* graded_axis = "graded intervals";
constexpr const char* positions_axis = "mesh positions";

FidelityLevel finest_level(const AccuracyTable& table) {
  return {finest_name, finest_name, ErrorKind::Both, table.compliance, table.gap, {QuadratureRule::Graded, table.intervals}, table.positions, true};
}

/// Halvings of a number, coarse to fine, down to the least.
std::vector<int> halvings(int from, int least) {
  std::vector<int> levels;
  for (int n = from / 2; n >= least; n /= 2) levels.insert(levels.begin(), n);
  return levels;
}

/// The finest level with one setting changed.
void add_varied(std::vector<FidelityLevel>& fidelity_levels, const char* axis, const std::string& name, ErrorKind kind, const auto& change) {
  FidelityLevel level = fidelity_levels.front();
  level.axis = axis;
  level.name = name;
  level.kind = kind;
  change(level);
  fidelity_levels.push_back(std::move(level));
}

void add_model_levels(const MeshEffects& effects, std::vector<FidelityLevel>& fidelity_levels) {
  const FidelityLevel finest = fidelity_levels.front();
  const auto add = [&](const char* axis, const char* name, const auto& change) { add_varied(fidelity_levels, axis, name, ErrorKind::Model, change); };
  for (const ComplianceModel model : {ComplianceModel::Rigid, ComplianceModel::ThinSlice, ComplianceModel::Fitted}) {
    if (model < finest.compliance) add("compliance", to_string(model), [&](FidelityLevel& r) { r.compliance = model; });
  }
  if (finest.gap == GapModel::WholeSurface) add("gap", to_string(GapModel::PlaneOfAction), [](FidelityLevel& r) { r.gap = GapModel::PlaneOfAction; });
  const auto leave_out = [&](const char* axis, const char* name, const char* effect) {
    if (effects.has(effect)) add(axis, name, [&](FidelityLevel& r) { r.left_out = {effect}; });
  };
  leave_out("contact law", "without free ends", "free_ends");
  leave_out("contact law", "without contact coupling", "contact_coupling");
  leave_out("contact law", "without tip corner", "tip_corner");
  leave_out("adjacent teeth", "without adjacent teeth", "adjacent_teeth");
  leave_out("gear bodies", "rigid gear bodies", "gear_body_compliance");
  leave_out("contact region", "between A and E only", "extended_contact_region");
}

void add_resolution_levels(std::vector<FidelityLevel>& fidelity_levels) {
  const FidelityLevel finest = fidelity_levels.front();
  const auto add = [&](const char* axis, const std::string& name, const auto& change) {
    add_varied(fidelity_levels, axis, name, ErrorKind::Discretisation, change);
  };
  const auto add_rule = [&](const char* axis, QuadratureRule rule, const char* name, const std::vector<int>& levels) {
    for (int n : levels) add(axis, fmt::format("{} {}", name, n), [&](FidelityLevel& r) { r.quadrature = {rule, n}; });
  };
  add_rule("gauss2 intervals", QuadratureRule::Gauss2, "gauss2", {3, 5, 10, 20, 40});
  add_rule("gauss3 intervals", QuadratureRule::Gauss3, "gauss3", {5, 10, 20});
  add_rule("midpoints", QuadratureRule::Midpoint, "midpoint", {10, 20, 40});
  add_rule(graded_axis, QuadratureRule::Graded, "graded", halvings(finest.quadrature.intervals, 2));
  for (int n : halvings(finest.positions, fewest_positions))
    add(positions_axis, fmt::format("{} positions", n), [&](FidelityLevel& r) { r.positions = n; });
  add("peaks", "peaks of the positions", [](FidelityLevel& r) { r.located_peaks = false; });
}

/// From what is done in a moment to nearly the finest.
void add_whole_settings(const FidelityLevel& finest, const Study& study, std::vector<FidelityLevel>& fidelity_levels) {
  const auto add = [&](const char* name, ComplianceModel compliance, Quadrature quadrature, int positions, bool located = false) {
    if (compliance > finest.compliance) return;
    fidelity_levels.push_back({name, "whole settings", ErrorKind::Both, compliance, GapModel::PlaneOfAction, quadrature, positions, located});
  };
  using enum ComplianceModel;
  add("quickest", ThinSlice, {QuadratureRule::Gauss2, 3}, 12);
  add("quick", ThinSlice, {QuadratureRule::Graded, 4}, 16);
  add("thin slices, fine", ThinSlice, {QuadratureRule::Graded, 8}, 32, true);
  add("fitted, coarse", Fitted, {QuadratureRule::Graded, 2}, 12);
  add("by default", Fitted, Fidelity{}.quadrature, Cycle{}.positions, true);
  add("fitted, fair", Fitted, {QuadratureRule::Graded, 4}, 16);
  add("fitted, good", Fitted, {QuadratureRule::Graded, 8}, 32);
  add("fitted, fine", Fitted, {QuadratureRule::Graded, 8}, 32, true);
  const Fidelity& given = study.fidelity;
  if (given.compliance <= finest.compliance) {
    fidelity_levels.push_back({"as the study has it", "whole settings", ErrorKind::Both, given.compliance, given.gap, given.quadrature,
                               std::max(fewest_positions, study.cycle.positions),
                               study.cycle.phases.empty() && study.cycle.locate_peaks.value_or(true)});
  }
}

/// The fidelity levels of a study, the finest first: one axis varied at a time from there, then whole settings.
std::vector<FidelityLevel> hierarchy_levels(const LevelRunner& runner) {
  const Study& study = runner.subject().study;
  const FidelityLevel finest = finest_level(study.table<AccuracyTable>());
  const MeshEffects effects = runner.effects(finest);
  std::vector<FidelityLevel> fidelity_levels{finest};
  add_model_levels(effects, fidelity_levels);
  add_resolution_levels(fidelity_levels);
  add_whole_settings(finest, study, fidelity_levels);
  return fidelity_levels;
}

/// The results of an axis that end at the reference, coarse to fine.
std::vector<const LevelResult*> sequence(const FidelityHierarchy& hierarchy, const char* axis) {
  std::vector<const LevelResult*> found;
  for (const HierarchyStep& step : hierarchy.steps) {
    if (step.result.level.axis == axis) found.push_back(&step.result);
  }
  found.push_back(&hierarchy.reference.result);
  return found;
}

/// Adds an axis' orders and what it says of the reference's own error.
void add_order(FidelityHierarchy& hierarchy, const char* axis, int (*level)(const FidelityLevel&)) {
  const std::vector<const LevelResult*> all = sequence(hierarchy, axis);
  if (all.size() < 3 || !std::ranges::all_of(all, &LevelResult::usable)) return;
  const std::span<const LevelResult* const> last(all.end() - 3, 3);
  AxisOrder orders{axis, {}, {}};
  for (const LevelResult* result : last) orders.levels.push_back(level(result->level));
  orders.order.fill(std::numeric_limits<double>::infinity());
  PerFigure error{};
  for (std::size_t s = 0; s < last[2]->scenes.size(); ++s) {
    const CycleFigures &coarse = last[0]->scenes[s], &middle = last[1]->scenes[s], &fine = last[2]->scenes[s];
    CycleFigures limit = fine;
    for (std::size_t i = 0; i < error.size(); ++i) {
      const LimitEstimate estimate = estimate_limit(coarse.value[i], middle.value[i], fine.value[i]);
      orders.order[i] = estimate.regular ? std::min(orders.order[i], estimate.order) : not_given;
      limit.value[i] += estimate.error;
    }
    const PerFigure of_scene = figure_errors(limit, fine);
    for (std::size_t i = 0; i < error.size(); ++i) error[i] = std::max(error[i], of_scene[i]);
  }
  for (std::size_t i = 0; i < error.size(); ++i) hierarchy.reference_error[i] += error[i];
  hierarchy.orders.push_back(orders);
}

OutsideFigures outside_figures(const OutsideCurve& curve) {
  const std::vector<double>& te = curve.transmission_error;
  OutsideFigures figures{curve.name, static_cast<int>(te.size())};
  const auto at = [&figures](Figure f) -> double& { return figures.value[static_cast<std::size_t>(f)]; };
  const auto [low, high] = std::ranges::minmax(te);
  at(Figure::TeMean) = std::accumulate(te.begin(), te.end(), 0.0) / figures.positions;
  at(Figure::TePeakToPeak) = high - low;
  std::ranges::copy(harmonic_amplitudes(te) | std::views::take(figure_harmonics), &at(Figure::TeHarmonic1));
  return figures;
}

/// See HierarchyStep::from_outside.
/// @param approach  of the flanks, mean over the cycle at the finest level [mm]
PerFigure outside_differences(const PerFigure& figures, const PerFigure& outside, double approach) {
  const double variation = std::max(outside[static_cast<std::size_t>(Figure::TePeakToPeak)], quiet_share * approach);
  PerFigure differences{};
  for (std::size_t i = 0; i < differences.size(); ++i)
    differences[i] = (figures[i] - outside[i]) / (static_cast<Figure>(i) == Figure::TeMean ? approach : variation);
  return differences;
}

/// Every level at the positions of the study's outside curve, if it has one.
void add_outside_differences(FidelityHierarchy& hierarchy, LevelRunner& runner) {
  const OutsideCurve& curve = runner.subject().study.table<AccuracyTable>().outside;
  if (curve.transmission_error.empty() || !hierarchy.usable()) return;
  hierarchy.outside = outside_figures(curve);
  for (HierarchyStep* step : all_steps(hierarchy)) {
    FidelityLevel level = step->result.level;
    level.positions = static_cast<int>(curve.transmission_error.size());
    level.located_peaks = false;
    const LevelResult result = runner.run(level);
    if (!result.usable()) continue;
    step->from_outside =
        outside_differences(result.scenes.front().value, hierarchy.outside->value, hierarchy.reference.result.scenes.front().mean_approach);
  }
}

void mark_best(FidelityHierarchy& hierarchy) {
  const std::vector<HierarchyStep*> all = all_steps(hierarchy);
  std::vector<double> cost, error;
  for (const HierarchyStep* step : all) {
    cost.push_back(step->result.seconds);
    error.push_back(largest(step->error));
  }
  const std::vector<bool> best = pareto_best(cost, error);
  for (std::size_t s = 0; s < all.size(); ++s) all[s]->best = best[s];
  for (std::size_t i = 0; i < figure_count; ++i) {
    for (std::size_t s = 0; s < all.size(); ++s) error[s] = all[s]->error[i];
    const std::vector<bool> best_in = pareto_best(cost, error);
    for (std::size_t s = 0; s < all.size(); ++s) all[s]->best_in[i] = best_in[s];
  }
}

}  // namespace

std::vector<bool> pareto_best(const std::vector<double>& cost, const std::vector<double>& error) {
  std::vector<bool> best(cost.size(), true);
  for (std::size_t i = 0; i < cost.size(); ++i) {
    for (std::size_t j = 0; j < cost.size(); ++j) {
      const bool no_worse = cost[j] <= cost[i] && error[j] <= error[i];
      if (no_worse && (cost[j] < cost[i] || error[j] < error[i])) best[i] = false;
    }
  }
  return best;
}

FidelityHierarchy run_hierarchy(LevelRunner& runner, const ProgressReport& progress) {
  const Stopwatch clock;
  FidelityHierarchy hierarchy;
  hierarchy.scenes = runner.subject().scenes;
  const std::vector<FidelityLevel> fidelity_levels = hierarchy_levels(runner);
  int done = 0;
  const auto step = [&](const FidelityLevel& level) {
    if (progress) progress("fidelity levels", done++, static_cast<int>(fidelity_levels.size()), level.name);
    HierarchyStep made{runner.run(level)};
    made.first_seconds = made.result.seconds + runner.first_seconds(level.compliance);
    return made;
  };
  hierarchy.reference = step(fidelity_levels.front());
  for (std::size_t i = 1; i < fidelity_levels.size(); ++i) {
    hierarchy.steps.push_back(step(fidelity_levels[i]));
    hierarchy.steps.back().error = worst_errors(hierarchy.steps.back().result, hierarchy.reference.result);
  }
  add_outside_differences(hierarchy, runner);
  if (hierarchy.usable()) {
    add_order(hierarchy, graded_axis, [](const FidelityLevel& r) { return r.quadrature.intervals; });
    add_order(hierarchy, positions_axis, [](const FidelityLevel& r) { return r.positions; });
  }
  mark_best(hierarchy);
  hierarchy.seconds = clock.seconds();
  return hierarchy;
}

}  // namespace flankwright::studies
