#include "studies/tasks/study_effect_sizes.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"

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
  return {results.pair, study.pinion_material, study.wheel_material, resolution, results.structures.pair.get(), results.shafts.get(),
          condition, torque};
}

void add_exact(const StudyResults& results, const LoadedResult& loaded, std::vector<SizeInStudy>& sizes) {
  const CycleOutputs with = cycle_outputs(results.models[loaded.model], loaded.cycle);
  const EffectScene scene = scene_of(results, loaded.condition, loaded.torque, {results.study.fidelity.quadrature, results.phases});
  for (const EffectDecision& decision : results.effects) {
    if (!decision.on || !changes_mesh(decision.name)) continue;
    const Stopwatch clock;
    EffectSize size{decision.name, {}, not_given};
    const EffectDecisions rest = without(results.effects, decision.name, "left out");
    if (mesh_effects(rest).give_way()) size.influence = EffectInfluence::between(with, outputs_with(scene, rest));
    size.seconds = clock.seconds();
    add(sizes, {loaded.scene, loaded.torque, size});
  }
}

}  // namespace

EffectSizes study_effect_sizes(const StudyResults& results) {
  EffectSizes sizes;
  const EffectSizing asked = results.study.fidelity.effect_sizes;
  std::vector<const LoadedResult*> cases;
  for (const LoadedResult& loaded : results.loaded) {
    if (asked != EffectSizing::Off && loaded.design != "before" && loaded.cycle.usable()) cases.push_back(&loaded);
  }
  std::vector<std::vector<EstimatedSize>> estimates(cases.size());
  EffectMeshes meshes;
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
    estimates[i] = estimate_effect_sizes(scene_of(results, cases[i]->condition, cases[i]->torque, estimate_resolution(results)), results.effects, {}, meshes);
  });
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const EstimatedSize& estimate : estimates[i]) {
      add(sizes.estimated, {cases[i]->scene, cases[i]->torque, estimate.size, estimate.positions, estimate.solved_again});
    }
    if (asked == EffectSizing::Exact) add_exact(results, *cases[i], sizes.exact);
  }
  return sizes;
}

void drop_small_effects(StudyResults& results, const std::vector<DesignScene>& scenes, double budget) {
  if (!(budget > 0.0) || !results.study.fidelity.automatic_effects) return;
  std::vector<SizeInStudy> largest;
  EffectMeshes meshes;
  for (const DesignScene& load_case : scenes) {
    const EffectScene scene = scene_of(results, load_case.condition, load_case.torque, estimate_resolution(results));
    for (const EstimatedSize& estimate : estimate_effect_sizes(scene, results.effects, {}, meshes)) {
      add(largest, {load_case.name, load_case.torque, estimate.size});
    }
  }
  std::vector<EffectSize> sizes;
  std::ranges::transform(largest, std::back_inserter(sizes), &SizeInStudy::size);
  results.effects = within_budget(results.effects, sizes, budget);
  results.mesh_effects = mesh_effects(results.effects);
}

}  // namespace flankwright::studies
