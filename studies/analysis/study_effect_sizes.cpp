#include "studies/analysis/study_effect_sizes.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/stopwatch.hpp"
#include "core/fidelity/resolution_level.hpp"
#include "core/fidelity/resolved_cycle.hpp"
#include "optimize/design/problem/for_each_in_parallel.hpp"
#include "studies/analysis/step_progress.hpp"

namespace flankwright::studies {

namespace {

/// Keeps the larger of two sizes of one effect, and the time of both.
void add(std::vector<SizeInStudy>& sizes, const SizeInStudy& other) {
  const auto known = std::ranges::find(sizes, other.size.name, [](const SizeInStudy& s) { return s.size.name; });
  if (known == sizes.end()) {
    sizes.push_back(other);
    return;
  }
  SizeInStudy larger = std::isnan(known->size.influence.share) || other.size.influence.share > known->size.influence.share ? other : *known;
  larger.size.seconds = known->size.seconds + other.size.seconds;
  larger.positions = known->positions + other.positions;
  larger.solved_again = known->solved_again + other.solved_again;
  *known = std::move(larger);
}

/// Estimates are made at the study's own positions and intervals, or at this many where there are more: what an effect does is larger than what
/// the resolution does to it.
constexpr int most_positions = 16, most_estimate_intervals = 6;

MeshResolution estimate_resolution(const StudyResults& results) {
  const bool few = std::ssize(results.phases) <= most_positions;
  Quadrature quadrature = results.study.fidelity.quadrature;
  if (quadrature.rule == QuadratureRule::Graded) quadrature.intervals = std::min(quadrature.intervals, most_estimate_intervals);
  return {quadrature, few ? results.phases : equally_spaced_phases(most_positions)};
}

EffectScene scene_of(const StudyResults& results, const FlankCondition& condition, double torque, const MeshResolution& resolution) {
  const Study& study = results.study;
  return {results.pair, study.material.pinion, study.material.wheel, resolution, results.structures.pair.get(), results.shafts.get(), condition,
          torque};
}

void add_exact(const StudyResults& results, const LoadedResult& loaded, std::vector<SizeInStudy>& sizes) {
  const CycleOutputs with = cycle_outputs(loaded.cycle);
  const EffectScene scene = scene_of(results, loaded.condition, loaded.torque, {results.study.fidelity.quadrature, results.phases});
  for (const EffectDecision& decision : results.effects) {
    if (!decision.on || !changes_mesh(decision.name)) continue;
    const Stopwatch clock;
    EffectSize size{decision.name, {}, not_given};
    const EffectDecisions rest = without(results.effects, decision.name, "left out");
    if (mesh_effects(rest).make_compliant()) size.influence = EffectInfluence::between(with, outputs_with(scene, rest));
    size.seconds = clock.seconds();
    add(sizes, {loaded.scene, loaded.torque, size});
  }
}

/// What is left out may change no figure by more than a budget over this: with and without it, figures have discretisation errors of their own.
constexpr double safety = 1.25;
constexpr int most_refusals = 2;

/// Estimates, largest over the load cases, of the effects that may be left out and whose size is within a budget in all of them.
std::vector<EffectSize> small_sizes(const StudyResults& results, const std::vector<DesignScene>& scenes, double budget) {
  std::vector<std::string> candidates;
  for (const EffectDecision& decision : results.effects) {
    if (decision.on && may_be_dropped(decision.name)) candidates.push_back(decision.name);
  }
  std::vector<SizeInStudy> largest;
  EffectMeshes meshes;
  for (const DesignScene& load_case : scenes) {
    const EffectScene scene = scene_of(results, load_case.condition, load_case.torque, estimate_resolution(results));
    for (const EstimatedSize& estimate : estimate_effect_sizes(scene, results.effects, {.only = candidates}, meshes)) {
      add(largest, {load_case.name, load_case.torque, estimate.size});
      // An effect that is too large, or unknown, in one load case is not estimated in the others.
      if (!(estimate.size.influence.share <= budget)) std::erase(candidates, estimate.size.name);
    }
    if (candidates.empty()) break;
  }
  std::vector<EffectSize> sizes;
  for (const SizeInStudy& size : largest) {
    if (std::ranges::find(candidates, size.size.name) != candidates.end()) sizes.push_back(size.size);
  }
  return sizes;
}

/// Figures of all load cases with these effects, at the study's own resolution, with the extremes between its positions; empty where a position failed.
std::vector<CycleFigures> figures_with(const StudyResults& results, const std::vector<DesignScene>& scenes, const EffectDecisions& decisions) {
  const Study& study = results.study;
  const MeshEffects effects = mesh_effects(decisions);
  const auto placement_of_scene = [&](const DesignScene& scene) {
    return placement_of(gap_model(decisions), scene.condition, results.shafts.get(), scene.torque);
  };
  const auto mesh = [&](const MeshPlacement& placement, const std::vector<double>& phases) {
    return make_mesh_model(results.pair, study.material, {study.fidelity.quadrature, phases}, effects, placement,
                           {.structure = results.structures.pair.get(), .shafts = results.shafts.get()});
  };
  std::map<MeshPlacement, MeshModel> models;
  for (const DesignScene& scene : scenes) {
    const MeshPlacement placement = placement_of_scene(scene);
    if (!models.contains(placement)) models.emplace(placement, mesh(placement, results.phases));
  }
  std::vector<CycleFigures> figures(scenes.size());
  std::vector<int> failures(scenes.size(), 0);
  tbb::parallel_for(std::size_t{0}, scenes.size(), [&](std::size_t i) {
    const DesignScene& scene = scenes[i];
    const MeshPlacement placement = placement_of_scene(scene);
    const MeshModel& model = models.at(placement);
    const LoadedCycle cycle = analyse_cycle(model, scene.condition, scene.torque, {}, RootStresses::Later);
    failures[i] = cycle.failures;
    if (!cycle.usable()) return;
    const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) { return mesh(placement, phases); };
    const CycleResolving resolving{.seek_extremes = seeks_extremes(study)};
    figures[i] = figures_of(cycle, resolve_cycle(model, cycle, at, scene.condition, scene.torque, resolving).summary);
  });
  if (std::ranges::any_of(failures, [](int failed) { return failed > 0; })) return {};
  return figures;
}

/// With safety; infinite where nothing is known.
PerFigure worst_change(const std::vector<CycleFigures>& without, const std::vector<CycleFigures>& with) {
  PerFigure worst{};
  if (without.size() != with.size()) worst.fill(std::numeric_limits<double>::infinity());
  for (std::size_t s = 0; s < without.size() && s < with.size(); ++s) {
    const PerFigure change = figure_differences(without[s], with[s]);
    for (std::size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], safety * change[i]);
  }
  return worst;
}

double least_headline(const PerFigure& values) {
  PerFigure turned = values;
  for (double& value : turned) value = -value;
  return -headline(turned);
}

/// Whether every figure of headline() keeps its budget.
bool within(const PerFigure& change, const PerFigure& budgets) {
  PerFigure excess{};
  for (std::size_t i = 0; i < excess.size(); ++i) excess[i] = change[i] - budgets[i];
  return headline(excess) <= 0.0;
}

/// Names of the effects that are on before and off after.
std::vector<std::string> switched_off(const EffectDecisions& before, const EffectDecisions& after) {
  std::vector<std::string> names;
  for (const EffectDecision& decision : before) {
    if (decision.on && !is_on(after, decision.name)) names.push_back(decision.name);
  }
  return names;
}

}  // namespace

EffectSizes study_effect_sizes(const StudyResults& results, const ProgressReport& progress) {
  EffectSizes sizes;
  const EffectSizing asked = results.study.fidelity.effect_sizes;
  std::vector<const LoadedResult*> cases;
  for (const LoadedResult& loaded : results.loaded) {
    if (asked != EffectSizing::Off && loaded.design != "before" && loaded.cycle.usable()) cases.push_back(&loaded);
  }
  std::vector<std::vector<EstimatedSize>> estimates(cases.size());
  std::vector<EffectScene> scenes;
  for (const LoadedResult* loaded : cases) scenes.push_back(scene_of(results, loaded->condition, loaded->torque, estimate_resolution(results)));
  EffectMeshes meshes;
  for (const EffectScene& scene : scenes) make_effect_meshes(scene, results.effects, meshes, for_each_in_parallel);
  StepProgress step(progress, "estimating sizes of effects", cases.size());
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
    estimates[i] = estimate_effect_sizes(scenes[i], results.effects, {}, meshes);
    step.add_one();
  });
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const EstimatedSize& estimate : estimates[i]) {
      add(sizes.estimated, {cases[i]->scene, cases[i]->torque, estimate.size, estimate.positions, estimate.solved_again});
    }
    if (asked == EffectSizing::Exact) add_exact(results, *cases[i], sizes.exact);
  }
  return sizes;
}

LeftOutEffects drop_small_effects(StudyResults& results, const std::vector<DesignScene>& scenes, const PerFigure& budgets) {
  LeftOutEffects left_out;
  const double budget = least_headline(budgets);
  if (!(budget > 0.0) || !results.study.fidelity.automatic_effects) return left_out;
  std::vector<EffectSize> sizes = small_sizes(results, scenes, budget);
  const std::vector<CycleFigures> with = sizes.empty() ? std::vector<CycleFigures>() : figures_with(results, scenes, results.effects);
  for (int refusals = 0; refusals < most_refusals && !sizes.empty() && !with.empty(); ++refusals) {
    const EffectDecisions rest = within_budget(results.effects, sizes, budget);
    const std::vector<std::string> names = switched_off(results.effects, rest);
    if (names.empty()) return left_out;
    const PerFigure change = worst_change(figures_with(results, scenes, rest), with);
    if (within(change, budgets)) {
      results.effects = rest;
      results.mesh_effects = mesh_effects(rest);
      return {names, change};
    }
    sizes.erase(std::ranges::max_element(
        sizes, {}, [&](const EffectSize& size) { return std::ranges::find(names, size.name) != names.end() ? size.influence.share : 0.0; }));
  }
  return left_out;
}

}  // namespace flankwright::studies
