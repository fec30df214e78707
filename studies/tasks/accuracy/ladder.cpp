#include "studies/tasks/accuracy/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

#include "core/base/limit_estimate.hpp"
#include "core/base/stopwatch.hpp"

namespace flankwright::studies {

namespace {

/// Orders 1 to 5 of the transmission error need 11 positions at least.
constexpr int fewest_positions = 12;
constexpr const char* finest_name = "finest";
constexpr const char* graded_axis = "graded intervals";
constexpr const char* positions_axis = "mesh positions";

Rung finest_rung(const AccuracyTable& table) {
  return {finest_name, finest_name, ErrorKind::Both, table.compliance, table.gap, {QuadratureRule::Graded, table.intervals}, table.positions, true};
}

/// Halvings of a number, coarse to fine, down to the least.
std::vector<int> halvings(int from, int least) {
  std::vector<int> levels;
  for (int n = from / 2; n >= least; n /= 2) levels.insert(levels.begin(), n);
  return levels;
}

/// The finest rung with one thing changed.
void add_varied(std::vector<Rung>& rungs, const char* axis, const std::string& name, ErrorKind kind, const auto& change) {
  Rung rung = rungs.front();
  rung.axis = axis;
  rung.name = name;
  rung.kind = kind;
  change(rung);
  rungs.push_back(std::move(rung));
}

void add_model_rungs(const MeshEffects& effects, std::vector<Rung>& rungs) {
  const Rung finest = rungs.front();
  const auto add = [&](const char* axis, const char* name, const auto& change) { add_varied(rungs, axis, name, ErrorKind::Model, change); };
  for (const ComplianceModel model : {ComplianceModel::Rigid, ComplianceModel::ThinSlice, ComplianceModel::Fitted}) {
    if (model < finest.compliance) add("compliance", to_string(model), [&](Rung& r) { r.compliance = model; });
  }
  if (finest.gap == GapModel::WholeSurface) add("gap", to_string(GapModel::PlaneOfAction), [](Rung& r) { r.gap = GapModel::PlaneOfAction; });
  const auto leave_out = [&](const char* axis, const char* name, const char* effect) {
    if (effects.has(effect)) add(axis, name, [&](Rung& r) { r.left_out = {effect}; });
  };
  leave_out("contact law", "without free ends", "free_ends");
  leave_out("contact law", "without tip corner", "tip_corner");
  leave_out("adjacent teeth", "without adjacent teeth", "adjacent_teeth");
  leave_out("gear bodies", "rigid gear bodies", "gear_body_compliance");
  leave_out("contact region", "between A and E only", "extended_contact_region");
}

void add_resolution_rungs(std::vector<Rung>& rungs) {
  const Rung finest = rungs.front();
  const auto add = [&](const char* axis, const std::string& name, const auto& change) {
    add_varied(rungs, axis, name, ErrorKind::Discretisation, change);
  };
  const auto add_rule = [&](const char* axis, QuadratureRule rule, const char* name, const std::vector<int>& levels) {
    for (int n : levels) add(axis, fmt::format("{} {}", name, n), [&](Rung& r) { r.quadrature = {rule, n}; });
  };
  add_rule("gauss2 intervals", QuadratureRule::Gauss2, "gauss2", {3, 5, 10, 20, 40});
  add_rule("gauss3 intervals", QuadratureRule::Gauss3, "gauss3", {5, 10, 20});
  add_rule("midpoints", QuadratureRule::Midpoint, "midpoint", {10, 20, 40});
  add_rule(graded_axis, QuadratureRule::Graded, "graded", halvings(finest.quadrature.intervals, 2));
  for (int n : halvings(finest.positions, fewest_positions)) add(positions_axis, fmt::format("{} positions", n), [&](Rung& r) { r.positions = n; });
  add("peaks", "peaks of the positions", [](Rung& r) { r.located_peaks = false; });
}

/// From what is done in a moment to nearly the finest.
void add_whole_settings(const Rung& finest, const Study& study, std::vector<Rung>& rungs) {
  const auto add = [&](const char* name, ComplianceModel compliance, Quadrature quadrature, int positions, bool located = false) {
    if (compliance > finest.compliance) return;
    rungs.push_back({name, "whole settings", ErrorKind::Both, compliance, GapModel::PlaneOfAction, quadrature, positions, located});
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
    rungs.push_back({"as the study has it", "whole settings", ErrorKind::Both, given.compliance, given.gap, given.quadrature,
                     std::max(fewest_positions, study.cycle.positions), study.cycle.phases.empty() && study.cycle.locate_peaks.value_or(true)});
  }
}

/// The results of an axis that end at the reference, coarse to fine.
std::vector<const RungResult*> sequence(const Ladder& ladder, const char* axis) {
  std::vector<const RungResult*> found;
  for (const LadderStep& step : ladder.steps) {
    if (step.result.rung.axis == axis) found.push_back(&step.result);
  }
  found.push_back(&ladder.reference.result);
  return found;
}

/// Adds an axis' orders and what it says of the reference's own error.
void add_order(Ladder& ladder, const char* axis, int (*level)(const Rung&)) {
  const std::vector<const RungResult*> all = sequence(ladder, axis);
  if (all.size() < 3 || !std::ranges::all_of(all, &RungResult::usable)) return;
  const std::span<const RungResult* const> last(all.end() - 3, 3);
  AxisOrder orders{axis, {}, {}};
  for (const RungResult* result : last) orders.levels.push_back(level(result->rung));
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
  for (std::size_t i = 0; i < error.size(); ++i) ladder.reference_error[i] += error[i];
  ladder.orders.push_back(orders);
}

void mark_best(Ladder& ladder) {
  std::vector<LadderStep*> all{&ladder.reference};
  for (LadderStep& step : ladder.steps) all.push_back(&step);
  std::vector<double> cost, error;
  for (const LadderStep* step : all) {
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

std::vector<Rung> ladder_rungs(const RungRunner& runner) {
  const Study& study = runner.subject().study;
  const Rung finest = finest_rung(study.accuracy);
  const MeshEffects effects = runner.effects(finest);
  std::vector<Rung> rungs{finest};
  add_model_rungs(effects, rungs);
  add_resolution_rungs(rungs);
  add_whole_settings(finest, study, rungs);
  return rungs;
}

Ladder climb_ladder(RungRunner& runner, const ProgressReport& progress) {
  const Stopwatch clock;
  Ladder ladder;
  ladder.scenes = runner.subject().scenes;
  const std::vector<Rung> rungs = ladder_rungs(runner);
  int done = 0;
  const auto step = [&](const Rung& rung) {
    if (progress) progress("climbing the ladder", done++, static_cast<int>(rungs.size()), rung.name);
    LadderStep made{runner.run(rung)};
    made.first_seconds = made.result.seconds + runner.first_seconds(rung.compliance);
    return made;
  };
  ladder.reference = step(rungs.front());
  for (std::size_t i = 1; i < rungs.size(); ++i) {
    ladder.steps.push_back(step(rungs[i]));
    ladder.steps.back().error = worst_errors(ladder.steps.back().result, ladder.reference.result);
  }
  if (ladder.usable()) {
    add_order(ladder, graded_axis, [](const Rung& r) { return r.quadrature.intervals; });
    add_order(ladder, positions_axis, [](const Rung& r) { return r.positions; });
  }
  mark_best(ladder);
  ladder.seconds = clock.seconds();
  return ladder;
}

}  // namespace flankwright::studies
